// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <chrono>
#include <cstdint>
#include <optional>
#include <string>

#include "app/model/alignment/rig_alignment.h"
#include "proc/image/result.h"

namespace orbwatch::app {

/// An alignment that was accepted, and how it came about.
struct CalibrationEntry {
  int number = 0;    ///< counts entries from 1
  std::string time;  ///< UTC, as utc_text()
  std::string method;
  std::string quality;
  /// Checksum of the rig file and its lenses that the alignment is for: it corrects no other. See
  /// rig_checksum().
  std::uint32_t rig = 0;
  RigAlignment alignment;  ///< one camera's; without members: the rig file counts
};

/// The one camera of an entry. Reentrant.
inline const CameraAlignment& camera_of(const CalibrationEntry& entry) {
  return entry.alignment.cameras.front();
}

/// The accepted alignments of a running site, in force from the next start on.
/// Thread rule: one caller at a time.
class AcceptedAlignments {
 public:
  virtual ~AcceptedAlignments() = default;

  /// Adds an alignment for the rig that runs, with which it was found. Returns its number. Error:
  /// it cannot be kept.
  virtual Result<int> add(CalibrationEntry entry) = 0;

  /// The entry that counted for a camera before the one that counts now; without an alignment: the
  /// rig file did. Nullopt: the rig file counts. Error: the entries cannot be read.
  virtual Result<std::optional<CalibrationEntry>> before(const std::string& camera) const = 0;

  /// True: an entry of that camera is younger than `age`. Entries that cannot be read are none.
  virtual bool is_young(const std::string& camera, std::chrono::minutes age) const = 0;
};

}  // namespace orbwatch::app
