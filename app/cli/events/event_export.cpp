// SPDX-License-Identifier: Apache-2.0
#include "app/cli/events/event_export.h"

#include <atomic>

#include "app/cli/command.h"
#include "app/cli/progress.h"
#include "app/ports/recorder/events/event_summary.h"
#include "app/ports/recorder/export/export_kinds.h"
#include "app/ports/recorder/export/staged_file.h"

namespace orbwatch::app::cli {
namespace {

using recorder::ExportKind;
using recorder::ExportSource;
using recorder::StagedFile;
using recorder::VideoText;

CliResult<const ExportKind*> kind_of(const std::filesystem::path& output) {
  const std::string ending = output.extension().string();
  std::string endings;
  for (const ExportKind& one : recorder::export_kinds()) {
    if (one.ending == ending) return &one;
    endings.append(endings.empty() ? "" : ", ").append(one.ending);
  }
  return usage_error(output.string() + ": the name must end with one of " + endings);
}

/// Writes the file beside its place, and moves it there.
Result<> write_whole(const ExportKind& kind, const ExportSource& source, const EventExport& o) {
  auto staged = StagedFile::beside(
      o.output, o.replaces ? recorder::Existing::Replaced : recorder::Existing::Kept);
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
  if (const auto finished = recorder::EventFolder::check_finished(event); !finished) {
    return tl::unexpected(finished.error());
  }
  const std::filesystem::path recording = event.folder / recorder::kEventFile;
  const auto range = recorder::stamps_in(recording, o.range);
  if (!range) return tl::unexpected(range.error());
  const auto written = write_whole(
      **kind, {recording, *range, o.camera, o.draws ? VideoText::Values : VideoText::None}, o);
  if (!written) return tl::unexpected(written.error());
  return o.output.string() + ": " + std::to_string(range->sets) + " frame sets\n";
}

}  // namespace orbwatch::app::cli
