// SPDX-License-Identifier: Apache-2.0
#include "app/daemon/alignment_record.h"

#include <algorithm>
#include <utility>

#include "app/files/runtime/calibration_file.h"
#include "app/log.h"
#include "app/model/status/utc_text.h"
#include "app/state/private_file.h"

namespace orbwatch::app::daemon {
namespace {

CalibrationEntry rig_files(const std::string& camera) {
  CalibrationEntry entry;
  entry.method = "reset to the rig file";
  entry.alignment.cameras.push_back({.camera = camera});
  return entry;
}

}  // namespace

AlignmentRecord::AlignmentRecord(const files::Resolved& site)
    : site_(site), file_(files::calibration_file(site.state_folder)) {}

/// Keeps a damaged file aside; then the alignments that run.
Result<std::vector<CalibrationEntry>> AlignmentRecord::load_or_mend() {
  files::TextFiles files;
  const auto entries = load_calibrations(file_, files);
  if (entries) return entries;
  return files::keep_damaged(file_).and_then([&](const std::filesystem::path& kept) {
    log_line(LogLevel::Warning, entries.error().message + "; it is kept as " + kept.string());
    files::TextFiles running(site_.calibration);
    return load_calibrations(file_, running);
  });
}

Result<int> AlignmentRecord::add(CalibrationEntry entry) {
  entry.rig = site_.rig_checksum;
  int number = 0;
  const auto add_to_file = [&]() -> Result<> {
    auto entries = load_or_mend();
    if (!entries) return tl::unexpected(entries.error());
    files::accept(*entries, std::move(entry));
    number = entries->back().number;
    return files::save_calibrations(file_, *entries);
  };
  return with_lock(file_, add_to_file).map([&] { return number; });
}

Result<std::optional<CalibrationEntry>> AlignmentRecord::before(const std::string& camera) const {
  files::TextFiles files;
  auto entries = load_calibrations(file_, files);
  if (!entries) return tl::unexpected(entries.error());
  std::erase_if(*entries, [&](const CalibrationEntry& entry) {
    return camera_of(entry).camera != camera || entry.rig != site_.rig_checksum;
  });
  if (entries->empty()) return std::nullopt;
  entries->pop_back();
  CalibrationEntry before = entries->empty() ? rig_files(camera) : entries->back();
  if (!entries->empty()) {
    before.method = "restored " + std::to_string(before.number) + ": " + before.method;
  }
  return before;
}

bool AlignmentRecord::is_young(const std::string& camera, std::chrono::minutes age) const {
  files::TextFiles files;
  const auto entries = load_calibrations(file_, files);
  const auto oldest = utc_text(std::chrono::system_clock::now() - age);
  return entries && std::ranges::any_of(*entries, [&](const CalibrationEntry& entry) {
           // Moments of one form: the later text is the later moment.
           return camera_of(entry).camera == camera && entry.time > oldest;
         });
}

}  // namespace orbwatch::app::daemon
