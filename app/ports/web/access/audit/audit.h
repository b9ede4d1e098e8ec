// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <functional>
#include <mutex>
#include <string>
#include <vector>

#include "app/ports/web/access/audit/audit_entry.h"
#include "app/ports/web/access/audit/audit_file.h"
#include "app/ports/web/access/audit/repetitions.h"

namespace orbwatch::app::web {

/// Audit trail. Entries of users and programs (audit), of commands over interfaces without accounts
/// (audit-commands) and of refused clients without a role (audit-refused) are in separate files, so
/// that clients without an account cannot displace other entries; of one kind of entries only the
/// first few of an hour are recorded individually. Thread-safe.
class Audit {
 public:
  /// Number of entries of one kind that are recorded individually, for users and interfaces and for
  /// clients without a role. A kind is user, action, result and subject; for commands over other
  /// interfaces interface, action and result; for clients without a role address, action and value.
  static constexpr std::uint64_t kFree = 20;
  static constexpr std::uint64_t kFreeRefused = 1;
  /// Limits for kinds within an hour, by users, by other interfaces and by clients without a role.
  static constexpr std::size_t kMostKinds = 1024;
  static constexpr std::size_t kMostCommandKinds = 512;
  static constexpr std::size_t kMostRefusedKinds = 512;
  /// Limits among the newest entries, by other interfaces and by clients without a role: a machine
  /// that commands all the time leaves room for users, also on a page that shows fewer.
  static constexpr std::size_t kMostCommandsShown = 40;
  static constexpr std::size_t kMostRefusedShown = 20;

  using Entry = AuditEntry;

  /// `state_folder` empty: nothing is recorded.
  explicit Audit(const std::filesystem::path& state_folder);

  /// Records an action of a user or program, or counts it. Entries with different `subject`s are
  /// never counted together; a text that a client chooses freely must not be one. Logs an error if
  /// the file cannot be written. Waits for the disk.
  void note(const Entry& entry, const std::string& subject = "");
  /// Counts a command over an interface without accounts; the next write_due() records the first
  /// ones. `interface` is a text of ours, and so is the action. Does not wait.
  void note_command(const Entry& entry, const std::string& interface);
  /// Counts a refused request of a client without a role; the next write_due() records the first
  /// ones. Returns the count of this kind within the hour. Does not wait.
  std::uint64_t note_refused(const Entry& entry);

  /// Records commands, refused requests, and counts that are due. Waits for the disk.
  void write_due(Repetitions::Time now);
  /// Like write_due(), and records all other counts.
  void write_all();

  /// The newest entries as AuditFile has them, the newest last, at most kMostCommandsShown of other
  /// interfaces and kMostRefusedShown of clients without a role. A tenth is reserved for the newest
  /// entries of each user, and of each such command, so that one cannot displace the others. Waits
  /// for the disk.
  std::vector<Json> newest(std::size_t most) const;

 private:
  /// Removes and returns the counts to be recorded.
  using TakeCounts = std::function<std::vector<Entry>(Repetitions&)>;

  /// Entries that are counted at once and recorded later.
  struct Deferred {
    Deferred(std::uint64_t free, std::size_t most_kinds) : repetitions(free, most_kinds) {}

    /// Returns the count of this kind within the hour.
    std::uint64_t note(const std::string& kind, const Entry& entry);
    /// Removes and returns the entries to be recorded, by time.
    std::vector<Entry> take(const TakeCounts& take_counts);

    Repetitions repetitions;
    std::vector<Entry> waiting;  ///< to be recorded individually; bounded by `repetitions`
  };

  void write(const TakeCounts& take_counts);

  AuditFile file_;
  AuditFile commands_file_;
  AuditFile refused_file_;
  std::mutex writing_;  ///< held from taking entries until they are on the disk: keeps their order
  std::mutex mutex_;    ///< guards the following members
  Repetitions repetitions_{kFree, kMostKinds};
  Deferred commands_{kFree, kMostCommandKinds};
  Deferred refused_{kFreeRefused, kMostRefusedKinds};
};

}  // namespace orbwatch::app::web
