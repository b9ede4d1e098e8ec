// SPDX-License-Identifier: Apache-2.0
#include "app/cli/events/event_export.h"

#include <algorithm>
#include <array>
#include <atomic>
#include <string_view>

#include "app/cli/command.h"
#include "app/cli/progress.h"
#include "app/ports/recorder/events/event_summary.h"
#include "app/ports/recorder/export/camera_video.h"
#include "app/ports/recorder/export/copied_range.h"
#include "app/ports/recorder/export/event_zip.h"
#include "app/ports/recorder/export/picture_stack.h"
#include "app/ports/recorder/export/staged_file.h"
#include "app/ports/recorder/export/state_table.h"

namespace orbwatch::app::cli {
namespace {

using recorder::ExportSteps;
using recorder::StagedFile;
using recorder::StampRange;
using recorder::VideoText;

/// An event, and the range of it.
struct ExportSource {
  std::filesystem::path recording;
  StampRange range;
  const EventExport& options;
};

/// A kind of file.
struct ExportKind {
  std::string_view ending;
  bool has_camera;  ///< pictures of one camera
  bool has_text;    ///< text can be drawn
  Result<> (*write)(const ExportSource& source, const std::filesystem::path& output,
                    const ExportSteps& steps);
};

constexpr std::array kExportKinds{
    ExportKind{".mcap", false, false,
               [](const ExportSource& source, const auto& output, const auto& steps) {
                 return copy_range(source.recording, source.range, output, steps);
               }},
    ExportKind{".csv", false, false,
               [](const ExportSource& source, const auto& output, const auto& steps) {
                 return write_state_table(source.recording, source.range, output, steps);
               }},
    ExportKind{".tif", true, false,
               [](const ExportSource& source, const auto& output, const auto& steps) {
                 return write_picture_stack(source.recording, source.options.camera, source.range,
                                            output, steps);
               }},
    ExportKind{".avi", true, true,
               [](const ExportSource& source, const auto& output, const auto& steps) {
                 const EventExport& o = source.options;
                 const auto text = o.draws ? VideoText::Values : VideoText::None;
                 return write_camera_video(source.recording, o.camera, source.range, text, output,
                                           steps);
               }},
    ExportKind{".zip", false, false,
               [](const ExportSource& source, const auto& output, const auto& steps) {
                 return write_event_zip(source.recording.parent_path(), source.range, output,
                                        steps);
               }},
};

CliResult<const ExportKind*> kind_of(const std::filesystem::path& output) {
  const std::string ending = output.extension().string();
  const auto* const kind = std::ranges::find(kExportKinds, ending, &ExportKind::ending);
  if (kind != kExportKinds.end()) return kind;
  std::string endings;
  for (const ExportKind& one : kExportKinds) {
    endings.append(endings.empty() ? "" : ", ").append(one.ending);
  }
  return usage_error(output.string() + ": the name must end with one of " + endings);
}

/// Writes the file beside its place, and moves it there.
Result<> write_whole(const ExportKind& kind, const ExportSource& source) {
  auto staged = StagedFile::beside(source.options.output, source.options.replaces
                                                              ? recorder::Existing::Replaced
                                                              : recorder::Existing::Kept);
  if (!staged) return tl::unexpected(staged.error());
  Progress progress;
  const std::atomic<bool>& is_cancelled = cancelled_by_signal();
  const auto steps = [&](std::size_t done, std::size_t of, const char* unit) {
    progress.count("exporting", done, of, unit);
    return !is_cancelled;
  };
  return kind.write(source, staged->path(), steps).and_then([&] { return staged->place(); });
}

}  // namespace

CliResult<std::string> export_event(const recorder::StoredEvent& event, const EventExport& o) {
  const auto kind = kind_of(o.output);
  if (!kind) return tl::unexpected(kind.error());
  if (!o.camera.empty() && !(*kind)->has_camera)
    return usage_error("--camera is for .tif and .avi");
  if (o.draws && !(*kind)->has_text) return usage_error("--draw is for .avi");
  if (!event.is_finished) return fail(event.name + " is being recorded; export it afterwards");
  const std::filesystem::path recording = event.folder / recorder::kEventFile;
  const auto range = recorder::stamps_in(recording, o.range);
  if (!range) return tl::unexpected(range.error());
  const auto written = write_whole(**kind, {recording, *range, o});
  if (!written) return tl::unexpected(written.error());
  return o.output.string() + ": " + std::to_string(range->sets) + " frame sets\n";
}

}  // namespace orbwatch::app::cli
