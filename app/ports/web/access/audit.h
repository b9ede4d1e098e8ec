#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <mutex>
#include <string>
#include <vector>

#include "app/ports/web/access/audit_entry.h"
#include "app/ports/web/access/audit_file.h"
#include "app/ports/web/access/repetitions.h"

namespace orbwatch::app::web {

/// The record of who did what. Entries of users and programs have files of their own (audit),
/// those of clients without a role, who were refused, other ones (audit-refused), so that nobody
/// without an account pushes anything else out; and of entries of one kind only the first few of an
/// hour are noted each. Thread-safe.
class Audit {
 public:
  /// Entries of one kind that are noted each, of a user and of a client without a role. A kind is
  /// who, what, result and subject; for clients without a role address, what and value.
  static constexpr std::uint64_t kFree = 20;
  static constexpr std::uint64_t kFreeRefused = 1;
  /// Limits for kinds within an hour, by users and by clients without a role.
  static constexpr std::size_t kMostKinds = 1024;
  static constexpr std::size_t kMostRefusedKinds = 512;
  /// Limit for refused entries among the newest ones.
  static constexpr std::size_t kMostRefusedShown = 20;

  using Entry = AuditEntry;

  /// An empty folder: nothing is kept.
  explicit Audit(const std::filesystem::path& state_folder);

  /// Notes what a user or program did, or counts it. Entries with different `subject`s are never
  /// counted together. Logs an error when it cannot be written. Waits for the disk.
  void note(const Entry& entry, const std::string& subject = "");
  /// Counts what a client without a role was refused; the next write_due() notes the first. Returns
  /// the number of this kind within the hour. Does not wait.
  std::uint64_t note_refused(const Entry& entry);

  /// Notes what was refused, and counts that are due. Waits for the disk.
  void write_due(Repetitions::Time now);
  /// The same, and all other counts.
  void write_all();

  /// `{"entries": [...]}` as JSON, the newest last, at most kMostRefusedShown of clients without a
  /// role; a tenth is for each user's newest ones, so that nobody pushes others' out of sight.
  /// Waits for the disk.
  std::string newest(std::size_t most) const;

 private:
  void write_waiting(std::vector<Entry> counts, std::vector<Entry> refused_counts);

  AuditFile file_;
  AuditFile refused_file_;
  std::mutex mutex_;  ///< of what follows
  Repetitions repetitions_{kFree, kMostKinds};
  Repetitions refused_{kFreeRefused, kMostRefusedKinds};
  std::vector<Entry> waiting_;  ///< refused ones to be noted as they are; bounded by refused_
};

}  // namespace orbwatch::app::web
