// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <chrono>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "app/files/resolve.h"
#include "app/model/alignment/accepted_alignments.h"
#include "proc/image/result.h"

namespace orbwatch::app::daemon {

/// The file of a running site's accepted alignments. Thread rule: one caller at a time.
class AlignmentRecord : public AcceptedAlignments {
 public:
  /// `site` outlives it.
  explicit AlignmentRecord(const files::Resolved& site);

  /// A damaged file is kept aside and written anew with the alignments that run. Waits for other
  /// programs that change the file. Error: as load_calibrations(), keep_damaged(),
  /// save_calibrations() and with_lock().
  Result<int> add(CalibrationEntry entry) override;

  /// Error: as load_calibrations().
  Result<std::optional<CalibrationEntry>> before(const std::string& camera) const override;

  bool is_young(const std::string& camera, std::chrono::minutes age) const override;

 private:
  Result<std::vector<CalibrationEntry>> load_or_mend();

  const files::Resolved& site_;
  const std::filesystem::path file_;
};

}  // namespace orbwatch::app::daemon
