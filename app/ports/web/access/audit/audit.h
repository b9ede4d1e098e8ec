// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <mutex>
#include <string>
#include <vector>

#include "app/ports/web/access/audit/audit_entry.h"
#include "app/ports/web/access/audit/audit_file.h"
#include "app/ports/web/access/audit/repetitions.h"

namespace orbwatch::app::web {

/// Audit trail. Entries of users and programs (audit) and of refused clients without a role
/// (audit-refused) are in separate files, so that clients without an account cannot displace other
/// entries; of one kind of entries only the first few of an hour are recorded individually.
/// Thread-safe.
class Audit {
 public:
  /// Number of entries of one kind that are recorded individually, for users and for clients
  /// without a role. A kind is user, action, result and subject; for clients without a role
  /// address, action and value.
  static constexpr std::uint64_t kFree = 20;
  static constexpr std::uint64_t kFreeRefused = 1;
  /// Limits for kinds within an hour, by users and by clients without a role.
  static constexpr std::size_t kMostKinds = 1024;
  static constexpr std::size_t kMostRefusedKinds = 512;
  /// Limit for refused entries among the newest ones.
  static constexpr std::size_t kMostRefusedShown = 20;

  using Entry = AuditEntry;

  /// `state_folder` empty: nothing is recorded.
  explicit Audit(const std::filesystem::path& state_folder);

  /// Records an action of a user or program, or counts it. Entries with different `subject`s are
  /// never counted together. Logs an error if the file cannot be written. Waits for the disk.
  void note(const Entry& entry, const std::string& subject = "");
  /// Counts a refused request of a client without a role; the next write_due() records the first
  /// ones. Returns the count of this kind within the hour. Does not wait.
  std::uint64_t note_refused(const Entry& entry);

  /// Records refused requests, and counts that are due. Waits for the disk.
  void write_due(Repetitions::Time now);
  /// Like write_due(), and records all other counts.
  void write_all();

  /// The newest entries as AuditFile has them, the newest last, at most kMostRefusedShown of
  /// clients without a role; a tenth is reserved for each user's newest entries, so that one user
  /// cannot displace those of others. Waits for the disk.
  std::vector<Json> newest(std::size_t most) const;

 private:
  void write_waiting(std::vector<Entry> counts, std::vector<Entry> refused_counts);

  AuditFile file_;
  AuditFile refused_file_;
  std::mutex mutex_;  ///< guards the following members
  Repetitions repetitions_{kFree, kMostKinds};
  Repetitions refused_{kFreeRefused, kMostRefusedKinds};
  /// Refused entries to be recorded individually; bounded by refused_.
  std::vector<Entry> waiting_;
};

}  // namespace orbwatch::app::web
