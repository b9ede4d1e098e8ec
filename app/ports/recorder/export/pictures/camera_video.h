// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <string>

#include "app/ports/recorder/export/export_range.h"
#include "app/ports/recorder/export/export_steps.h"
#include "proc/image/result.h"

namespace orbwatch::app::recorder {

/// Text below the pictures of a video.
enum class VideoText {
  None,
  Values  ///< UTC, frame set, and its valid signals and machine state
};

/// Writes the pictures of a camera as the new video `output`, MJPEG in AVI: the recorded part, at
/// the rate of their median interval. JPEG of the recording remains as it is unless there is text;
/// 16 bit is stretched from the darkest to the brightest pixel of all pictures. Errors: those of
/// CameraPictures and AviWriter; pictures of different sizes; cancelled.
Result<> write_camera_video(const std::filesystem::path& recording, const std::string& camera,
                            const StampRange& range, VideoText text,
                            const std::filesystem::path& output, const ExportSteps& steps);

}  // namespace orbwatch::app::recorder
