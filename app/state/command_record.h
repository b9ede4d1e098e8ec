#pragma once

#include <atomic>
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <memory>
#include <mutex>
#include <vector>

#include "app/model/command.h"
#include "app/state/slot_file.h"

namespace orbwatch::app {

/// Identifies a command: who gave it, and its number among those of this client.
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
  bool stopped = false;      ///< by the command stop

  bool operator==(const Selection&) const = default;
};

/// The newest command of each client, kept on the disk: noted before it is carried out, and with
/// its result before that is told. So a command is carried out at most once, whatever ends the
/// process. One that the process did not survive reads Interrupted.
/// Without a usable folder, or after the file was damaged, nobody knows what was carried out
/// before: the first command of each client is answered NotCarriedOut. A command that cannot be
/// noted in an open file is answered so, too.
///
/// It also keeps the recipe that was selected and whether measuring was stopped, for the run that
/// follows when the process executes itself again: with another alignment, other files or on
/// command. Such a restart comes in the middle of the machine's work, often unasked, and must
/// neither change the recipe nor start what was stopped. After a crash or a power cut, and when the
/// service is started, they are not restored: a recipe that ends the process must not end each run
/// after it, and the machine may have been set up for another part. Whether the process is active
/// is never kept: only who sees the process may say so. Thread-safe. carry_out waits for the disk,
/// twice, and for the handler in between.
class CommandRecord {
 public:
  /// One more removes the client that has been silent longest, never the PLC.
  static constexpr std::size_t kMaxClients = 256;

  struct Entry {
    CommandId id;
    std::uint16_t command = 0;  ///< its code, 0 for none
    CommandResult result = CommandResult::Interrupted;

    bool operator==(const Entry&) const = default;
  };

  /// Of a new appliance, kept as long as this object.
  CommandRecord() = default;

  /// Continues the record in `folder`, or begins one; complains in the log.
  explicit CommandRecord(const std::filesystem::path& folder);

  /// A file keeps the commands: one is open and the newest write to it succeeded.
  bool is_kept() const { return is_kept_; }

  /// By the time of the newest command, the oldest first.
  std::vector<Entry> entries() const;

  /// Selections of this process's runs so far.
  Selection selection() const;

  /// The caller judged the command to be new by entries() and by what it gave to carry_out since.
  CommandResult carry_out(const CommandId& id, const Command& command,
                          const CommandHandler& handler);

 private:
  bool begin(const CommandId& id, CommandCode code);
  void finish(const CommandId& id, const Command& command, CommandResult result);
  bool is_first_of_unknown(std::uint64_t client) const;
  Entry& renew(std::uint64_t client);
  void load(const SlotFile::Content& content);
  bool save();

  mutable std::mutex mutex_;        ///< of what follows, also while the disk is written
  std::unique_ptr<SlotFile> file_;  ///< null: kept in memory only
  std::vector<Entry> entries_;      ///< oldest first
  Selection selection_;
  bool knows_plc_ = true;     ///< nothing was carried out for it but what is in entries_
  bool knows_others_ = true;  ///< as much of the clients of this run
  std::atomic<bool> is_kept_{false};
};

}  // namespace orbwatch::app
