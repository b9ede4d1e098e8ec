// SPDX-License-Identifier: Apache-2.0
#include "app/ports/recorder/export/export_kinds.h"

#include <array>

#include "app/ports/recorder/export/copied_range.h"
#include "app/ports/recorder/export/event_zip.h"
#include "app/ports/recorder/export/pictures/picture_stack.h"
#include "app/ports/recorder/export/state_table.h"

namespace orbwatch::app::recorder {
namespace {

constexpr std::array<ExportKind, kExportFormats.size()> kExportKinds{
    {{ExportFormat::Mcap, ".mcap", false, false,
      [](const ExportSource& source, const auto& output, const auto& steps) {
        return copy_range(source.recording, source.range, output, steps);
      }},
     {ExportFormat::Csv, ".csv", false, false,
      [](const ExportSource& source, const auto& output, const auto& steps) {
        return write_state_table(source.recording, source.range, output, steps);
      }},
     {ExportFormat::Tiff, ".tif", true, false,
      [](const ExportSource& source, const auto& output, const auto& steps) {
        return write_picture_stack(source.recording, source.camera, source.range, output, steps);
      }},
     {ExportFormat::Avi, ".avi", true, true,
      [](const ExportSource& source, const auto& output, const auto& steps) {
        return write_camera_video(source.recording, source.camera, source.range, source.text,
                                  output, steps);
      }},
     {ExportFormat::Zip, ".zip", false, false,
      [](const ExportSource& source, const auto& output, const auto& steps) {
        return write_event_zip(source.recording.parent_path(), source.range, output, steps);
      }}}};

}  // namespace

std::span<const ExportKind> export_kinds() { return kExportKinds; }

}  // namespace orbwatch::app::recorder
