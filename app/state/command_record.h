// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <atomic>
#include <chrono>
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <memory>
#include <mutex>
#include <optional>
#include <vector>

#include "app/model/command/command.h"
#include "app/state/slot_file.h"
#include "hal/thread/bounded_queue.h"
#include "proc/image/result.h"

namespace orbwatch::app {

/// Identifies a command by its client and its number among the client's commands.
struct CommandId {
  std::uint64_t client = 0;
  std::uint64_t number = 0;

  bool operator==(const CommandId&) const = default;
};

/// The client behind the command registers of Modbus, which all PLCs share; its numbers are the
/// sequences. Other clients have other numbers.
inline constexpr std::uint64_t kPlcClient = 0;

/// Selections of the last commands.
struct Selection {
  std::uint16_t recipe = 0;  ///< its number; 0: no command selected one
  bool stopped = false;      ///< measuring is stopped by the command stop

  bool operator==(const Selection&) const = default;
};

/// An answered command that waits for the audit.
struct UnauditedCommand {
  std::chrono::system_clock::time_point time{};  ///< of the result
  CommandId id;
  Command command;  ///< with its giver
  CommandResult result = CommandResult::Done;
};

/// The newest command of each client, kept on the disk: recorded before it is executed, and with
/// its result before the answer. So a command is executed at most once, whatever ends the process.
/// A command during which the process ended reads Interrupted. Without a usable folder, or with a
/// damaged file, it is unknown which commands were executed before: the first command of each
/// client is answered NotCarriedOut, like a command that cannot be recorded in an open file. Each
/// command tries the folder again; once it is usable, its file holds the commands of this run, not
/// those of an earlier one, which the clients' ports do not know.
///
/// It also keeps the selected recipe and the state stopped, for the next run when the process
/// executes itself again: with another alignment, other files or on command. Such a restart occurs
/// during the machine's work, often unrequested, and must neither change the recipe nor resume
/// stopped measuring. After a crash or a power cut, and when the service is started, they are not
/// restored: a recipe that crashes the process must not crash each run after it, and the machine
/// may have been set up for another part. The state process active is never kept: only a client
/// that observes the process may set it.
///
/// Answered commands wait in memory for the audit, which another port writes, if there is one. A
/// command never waits for it: those beyond kMostUnaudited are only counted, and a crash loses
/// those that wait. Thread-safe. carry_out waits for the disk, twice, and for the handler in
/// between.
class CommandRecord {
 public:
  /// Limit of clients; a further one replaces the client that has been silent longest, never the
  /// PLC.
  static constexpr std::size_t kMaxClients = 256;
  /// Limit of commands that wait for the audit; enough while its disk is busy for some seconds.
  static constexpr std::size_t kMostUnaudited = 256;

  struct Entry {
    CommandId id;
    std::uint16_t command = 0;  ///< its code, 0 for none
    CommandResult result = CommandResult::Interrupted;

    bool operator==(const Entry&) const = default;
  };

  /// Begins an empty record that is kept in memory only.
  CommandRecord() = default;

  /// Continues the record in `folder`, or begins one; logs errors.
  explicit CommandRecord(const std::filesystem::path& folder);

  /// Returns whether a file keeps the commands: it is open and the newest write to it succeeded.
  bool is_kept() const { return is_kept_; }

  /// Entries by the time of the newest command, the oldest first.
  std::vector<Entry> entries() const;

  /// Selections of this process's runs so far.
  Selection selection() const;

  /// Replaces the selected recipe `refused`, which a camera refused after its command was done, by
  /// the one that is measured. Another selection is a newer one, and stays. Waits for the disk.
  void replace_recipe(std::uint16_t refused, std::uint16_t measured);

  /// Executes a command that the caller found to be new, by entries() and by the commands that it
  /// passed since. Afterwards it waits for the audit, also if it was not carried out.
  CommandResult carry_out(const CommandId& id, const Command& command,
                          const CommandHandler& handler);

  /// Like carry_out(), for a caller that audits the command: it does not wait for the audit.
  CommandResult carry_out_audited(const CommandId& id, const Command& command,
                                  const CommandHandler& handler);

  /// Removes and returns the oldest command that waits for the audit; nullopt: none waits. Does not
  /// wait for the disk.
  std::optional<UnauditedCommand> take_unaudited() { return unaudited_.try_take(); }

  /// Number of commands that the audit misses, because kMostUnaudited waited already.
  std::uint64_t lost_unaudited() const { return unaudited_.drops(); }

 private:
  Result<> open();
  void retry_open();
  bool begin(const CommandId& id, CommandCode code);
  void finish(const CommandId& id, const Command& command, CommandResult result);
  bool is_first_of_unknown(std::uint64_t client) const;
  Entry& renew(std::uint64_t client);
  void load(const SlotFile::Content& content);
  bool save();

  const std::filesystem::path path_;  ///< of the file; empty: there is none
  mutable std::mutex mutex_;  ///< guards the following members, also during writes to the disk
  std::unique_ptr<SlotFile> file_;  ///< null: kept in memory only, or not usable yet
  std::vector<Entry> entries_;      ///< oldest first
  Selection selection_;
  bool knows_plc_ = true;     ///< entries_ is complete for the PLC
  bool knows_others_ = true;  ///< entries_ is complete for the other clients
  std::atomic<bool> is_kept_{false};
  hal::BoundedQueue<UnauditedCommand, kMostUnaudited> unaudited_;
};

}  // namespace orbwatch::app
