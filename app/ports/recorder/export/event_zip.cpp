// SPDX-License-Identifier: Apache-2.0
#include "app/ports/recorder/export/event_zip.h"

#include <chrono>
#include <string>
#include <system_error>

#include "app/ports/recorder/events/event_summary.h"
#include "app/ports/recorder/export/copied_range.h"
#include "app/ports/recorder/export/staged_file.h"
#include "app/ports/recorder/export/state_table.h"
#include "app/ports/recorder/export/zip_writer.h"

namespace orbwatch::app::recorder {
namespace {

constexpr const char* kStateTable = "states.csv";

/// Place of a file that is removed when it is in the archive.
Result<StagedFile> part_of_zip(const std::filesystem::path& output, const char* name) {
  return StagedFile::beside(output.string() + "-" + name, Existing::Kept);
}

/// Archives the folder, with recording and table of the range.
Result<> zip_folder(const std::filesystem::path& event, const std::filesystem::path& recording,
                    const std::filesystem::path& table, const std::filesystem::path& output,
                    const ExportSteps& steps) {
  const auto now = std::chrono::floor<std::chrono::seconds>(std::chrono::system_clock::now());
  auto zip = ZipWriter::create(output, now);
  if (!zip) return tl::unexpected(zip.error());
  const std::string folder = event.filename().string() + "/";
  std::error_code none;
  const bool has_picture = std::filesystem::exists(event / kEventPicture, none);
  return zip->add(folder + kEventFile, recording, steps)
      .and_then([&] { return zip->add(folder + kStateTable, table, steps); })
      .and_then([&] { return zip->add(folder + kEventSummary, event / kEventSummary, steps); })
      .and_then([&]() -> Result<> {
        if (!has_picture) return {};
        return zip->add(folder + kEventPicture, event / kEventPicture, steps);
      })
      .and_then([&] { return zip->finish(); });
}

}  // namespace

Result<> write_event_zip(const std::filesystem::path& event, const StampRange& range,
                         const std::filesystem::path& output, const ExportSteps& steps) {
  const auto recording = part_of_zip(output, kEventFile);
  if (!recording) return tl::unexpected(recording.error());
  const auto table = part_of_zip(output, kStateTable);
  if (!table) return tl::unexpected(table.error());
  return copy_range(event / kEventFile, range, recording->path(), steps)
      .and_then([&] { return write_state_table(event / kEventFile, range, table->path(), steps); })
      .and_then([&] { return zip_folder(event, recording->path(), table->path(), output, steps); });
}

}  // namespace orbwatch::app::recorder
