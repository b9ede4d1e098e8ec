#pragma once

#include <chrono>
#include <optional>
#include <string>

#include "app/files/resolve.h"
#include "proc/image/result.h"

namespace orbwatch::app {

/// The file of a running site's accepted alignments. What it says counts from the next start on.
/// Thread rule: one caller at a time.
class AcceptedAlignments {
 public:
  /// `site` outlives it.
  explicit AcceptedAlignments(const Resolved& site);

  /// Adds an alignment for the rig that runs, with which it was found, whatever the rig file says
  /// by now. A damaged file is kept aside and written anew with what runs. Waits for other programs
  /// that change the file. Returns the number. Error: as load_calibrations(), keep_damaged(),
  /// save_calibrations() and with_lock().
  Result<int> add(CalibrationEntry entry);

  /// What counted for a camera before the one that counts now; without an alignment: the rig file
  /// did. Nullopt: the rig file counts. Error: as load_calibrations().
  Result<std::optional<CalibrationEntry>> before(const std::string& camera) const;

  /// Whether an entry of that camera is younger than `age`. An unreadable file is another's
  /// concern.
  bool is_young(const std::string& camera, std::chrono::minutes age) const;

 private:
  Result<std::vector<CalibrationEntry>> load_or_mend();

  const Resolved& site_;
  const std::filesystem::path file_;
};

}  // namespace orbwatch::app
