// SPDX-License-Identifier: Apache-2.0
#include "app/state/command_record.h"

#include <algorithm>
#include <array>
#include <cstring>
#include <string>
#include <utility>

#include "app/log.h"
#include "app/state/process_identity.h"

namespace orbwatch::app {
namespace {

constexpr const char* kFile = "commands";

/// Content of a slot. Its layout belongs to SlotFile::kVersion.
struct StoredEntry {
  std::uint64_t client = 0;
  std::uint64_t number = 0;
  std::uint16_t command = 0;
  std::uint16_t result = 0;
  std::uint32_t reserved = 0;
};
struct StoredSelection {
  std::uint64_t start = 0;  ///< start of the process for which it is kept
  std::uint32_t process = 0;
  std::uint16_t recipe = 0;
  std::uint16_t stopped = 0;
  std::array<char, 40> boot{};
};
struct StoredRecord {
  std::uint32_t count = 0;
  std::uint32_t plc_is_unknown = 0;
  std::array<StoredEntry, CommandRecord::kMaxClients> entries{};
  StoredSelection selection{};  ///< zero in files of earlier releases
};
static_assert(sizeof(StoredRecord) <= sizeof(SlotFile::Content));

/// Applies an executed command to the selection.
void note(const Command& command, Selection& selection) {
  if (command.code == CommandCode::SelectRecipe) {
    selection.recipe = static_cast<std::uint16_t>(command.integer(0));
  }
  if (command.code == CommandCode::Start) selection.stopped = false;
  if (command.code == CommandCode::Stop) selection.stopped = true;
}

StoredSelection to_store(const Selection& selection) {
  const ProcessIdentity process = this_process();
  StoredSelection stored{.start = process.start,
                         .process = process.id,
                         .recipe = selection.recipe,
                         .stopped = selection.stopped ? std::uint16_t{1} : std::uint16_t{0}};
  std::ranges::copy(process.boot, stored.boot.begin());
  return stored;
}

/// Returns the selection if this process stored it, else an empty one.
Selection kept(const StoredSelection& selection) {
  const StoredSelection own = to_store({});
  const bool is_own = own.start != 0 && selection.start == own.start &&
                      selection.process == own.process && selection.boot == own.boot;
  return is_own ? Selection{selection.recipe, selection.stopped != 0} : Selection{};
}

}  // namespace

CommandRecord::CommandRecord(const std::filesystem::path& folder) : path_(folder / kFile) {
  const auto content = open().and_then([this] { return file_->content(); });
  if (content) {
    load(*content);
    return;
  }
  knows_plc_ = knows_others_ = false;
  log_line(LogLevel::Warning, content.error().message +
                                  "; the first command of each client is not carried out, because "
                                  "it may have been before");
}

Result<> CommandRecord::open() {
  return SlotFile::open(path_).map([this](std::unique_ptr<SlotFile> opened) {
    file_ = std::move(opened);
    is_kept_ = true;
  });
}

/// Opens the file of a folder that was not usable at the start; without it the next start would
/// take the file's last command, which is outdated, for the newest.
void CommandRecord::retry_open() {
  if (file_ || path_.empty() || !open()) return;
  log_line(LogLevel::Info, path_.string() + ": is usable again; commands are recorded from now on");
}

std::vector<CommandRecord::Entry> CommandRecord::entries() const {
  const std::lock_guard lock(mutex_);
  return entries_;
}

Selection CommandRecord::selection() const {
  const std::lock_guard lock(mutex_);
  return selection_;
}

void CommandRecord::replace_recipe(std::uint16_t refused, std::uint16_t measured) {
  const std::lock_guard lock(mutex_);
  if (selection_.recipe != refused) return;
  selection_.recipe = measured;
  save();
}

CommandResult CommandRecord::carry_out(const CommandId& id, const Command& command,
                                       const CommandHandler& handler) {
  const CommandResult result = carry_out_audited(id, command, handler);
  unaudited_.put({std::chrono::system_clock::now(), id, command, result});  // counts a refused one
  return result;
}

CommandResult CommandRecord::carry_out_audited(const CommandId& id, const Command& command,
                                               const CommandHandler& handler) {
  if (!begin(id, command.code)) return CommandResult::NotCarriedOut;
  const CommandResult result = handler(command);
  finish(id, command, result);
  return result;
}

/// Records the command as begun. False: it must not be executed.
bool CommandRecord::begin(const CommandId& id, CommandCode code) {
  const std::lock_guard lock(mutex_);
  retry_open();
  const bool may_be_known = is_first_of_unknown(id.client);
  Entry& entry = renew(id.client);
  entry = {id, static_cast<std::uint16_t>(code),
           may_be_known ? CommandResult::NotCarriedOut : CommandResult::Interrupted};
  if (save() && !may_be_known) return true;
  entry.result = CommandResult::NotCarriedOut;
  return false;
}

void CommandRecord::finish(const CommandId& id, const Command& command, CommandResult result) {
  const std::lock_guard lock(mutex_);
  if (result == CommandResult::Done) note(command, selection_);
  const auto entry = std::ranges::find(entries_, id, &Entry::id);
  if (entry == entries_.end()) return;  // replaced by 256 other clients meanwhile
  entry->result = result;
  save();
}

bool CommandRecord::is_first_of_unknown(std::uint64_t client) const {
  if (client == kPlcClient ? knows_plc_ : knows_others_) return false;
  return std::ranges::none_of(entries_, [&](const Entry& e) { return e.id.client == client; });
}

/// Replaces the client's entry by an empty one at the end, and returns that.
CommandRecord::Entry& CommandRecord::renew(std::uint64_t client) {
  const auto is_of = [client](const Entry& e) { return e.id.client == client; };
  auto place = std::ranges::find_if(entries_, is_of);
  if (place == entries_.end() && entries_.size() == kMaxClients) {
    place =
        std::ranges::find_if(entries_, [](const Entry& e) { return e.id.client != kPlcClient; });
  }
  if (place != entries_.end()) entries_.erase(place);
  return entries_.emplace_back();
}

void CommandRecord::load(const SlotFile::Content& content) {
  StoredRecord stored;
  std::memcpy(&stored, content.data(), sizeof stored);
  knows_plc_ = stored.plc_is_unknown == 0;
  selection_ = kept(stored.selection);
  for (std::size_t i = 0; i < std::min<std::size_t>(stored.count, kMaxClients); ++i) {
    const StoredEntry& entry = stored.entries[i];
    entries_.push_back(
        {{entry.client, entry.number}, entry.command, static_cast<CommandResult>(entry.result)});
  }
}

/// Returns false if there is a file and it cannot be written.
bool CommandRecord::save() {
  if (!file_) return true;
  StoredRecord stored{.count = static_cast<std::uint32_t>(entries_.size()),
                      .plc_is_unknown = knows_plc_ ? 0U : 1U,
                      .selection = to_store(selection_)};
  for (std::size_t i = 0; i < entries_.size(); ++i) {
    const Entry& entry = entries_[i];
    stored.entries[i] = {entry.id.client, entry.id.number, entry.command,
                         static_cast<std::uint16_t>(entry.result)};
  }
  SlotFile::Content content{};
  std::memcpy(content.data(), &stored, sizeof stored);
  const auto written = file_->write(content);
  if (!written && is_kept_) {
    log_line(LogLevel::Error, written.error().message + "; commands are not carried out");
  }
  is_kept_ = written.has_value();
  return is_kept_;
}

}  // namespace orbwatch::app
