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

  /// Adds an alignment, for the rig file as it is now: what changed it since the start is not in
  /// force yet. A damaged file is kept aside and written anew with what runs. Returns the number.
  /// Error: as load_calibrations(), keep_damaged() and save_calibrations().
  Result<int> add(CalibrationEntry entry);

  /// What counted for a camera before the one that counts now; without an alignment: the rig file
  /// did. Nullopt: the rig file counts. Error: as load_calibrations().
  Result<std::optional<CalibrationEntry>> before(const std::string& camera) const;

  /// Whether an entry of that camera is younger than `age`. An unreadable file is another's
  /// concern.
  bool is_young(const std::string& camera, std::chrono::minutes age) const;

 private:
  Result<std::vector<CalibrationEntry>> load_or_mend();
  /// 0: it cannot be read.
  std::uint32_t rig() const;

  const Resolved& site_;
  const std::filesystem::path file_;
};

}  // namespace orbwatch::app
