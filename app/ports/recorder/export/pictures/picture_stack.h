// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <string>

#include "app/ports/recorder/export/export_range.h"
#include "app/ports/recorder/export/export_steps.h"
#include "proc/image/result.h"

namespace orbwatch::app::recorder {

/// Writes the pictures of a camera as the pages of the new TIFF file `output`, samples unchanged.
/// The description of each is JSON: utc, camera, frame_set, x and y of the recorded part in the
/// camera's picture of width and height, and, if the recording states the scale of the counts,
/// celsius_per_count and celsius_at_zero. Errors: those of CameraPictures and TiffWriter; pictures
/// that TIFF does not have as they are; cancelled.
Result<> write_picture_stack(const std::filesystem::path& recording, const std::string& camera,
                             const StampRange& range, const std::filesystem::path& output,
                             const ExportSteps& steps);

}  // namespace orbwatch::app::recorder
