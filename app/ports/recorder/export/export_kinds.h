// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <span>
#include <string>
#include <string_view>

#include "app/model/sink/recorded_exports.h"
#include "app/ports/recorder/export/export_range.h"
#include "app/ports/recorder/export/export_steps.h"
#include "app/ports/recorder/export/pictures/camera_video.h"
#include "proc/image/result.h"

namespace orbwatch::app::recorder {

/// A range of an event, to be written.
struct ExportSource {
  std::filesystem::path recording;
  StampRange range;
  std::string camera;  ///< of pictures; may be empty if the recording has one alone
  VideoText text = VideoText::None;
};

/// A kind of file.
struct ExportKind {
  ExportFormat format;
  std::string_view ending;  ///< of its name
  bool has_camera;          ///< pictures of one camera
  bool has_text;            ///< text can be drawn
  /// Writes the new file `output`, and others beside it meanwhile. Errors: those of the kind.
  Result<> (*write)(const ExportSource& source, const std::filesystem::path& output,
                    const ExportSteps& steps);
};

/// All kinds, in the order of kExportFormats.
std::span<const ExportKind> export_kinds();

}  // namespace orbwatch::app::recorder
