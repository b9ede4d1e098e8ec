// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <set>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "app/ports/recorder/events/event_triggers.h"
#include "app/ports/recorder/messages.h"
#include "proc/image/result.h"

namespace orbwatch::app::recorder {

/// An event on the disk.
struct StoredEvent {
  std::string name;
  std::filesystem::path folder;
  std::uint64_t bytes = 0;
  bool is_pinned = false;
  bool is_finished = true;  ///< false: it is being recorded, or its recorder ended early
  /// Time of the last change of names in `folder`, see settled_change().
  std::optional<std::filesystem::file_time_type> changed;

  bool operator==(const StoredEvent&) const = default;
};

/// The folder `events` of recordings: one folder for each event, which is the truth; no index
/// is stored beside it. An event that is being recorded has the name NAME.unfinished, one that is
/// being deleted NAME.deleted, one that is being restored NAME.restoring. What has other names is
/// not touched. Thread-bound; waits for the disk.
class EventFolder {
 public:
  explicit EventFolder(const std::filesystem::path& recordings) : root_(recordings / "events") {}

  const std::filesystem::path& path() const { return root_; }

  /// Finishes events whose recorder ended early, ends deletions, except of events that are pinned,
  /// which are kept, and deletes what an interrupted restore left an hour ago or earlier. What the
  /// disk prevents is logged once and tried again by the next call; an event whose content is
  /// refused stays. Errors: the folder; a full disk, for which they wait.
  Result<> prepare();

  /// The oldest first by their names; none without the folder. Those of the list `known` whose
  /// folders have not changed since are not read again. Error: the folder.
  Result<std::vector<StoredEvent>> list(std::span<const StoredEvent> known = {}) const;
  /// Errors: not the name of an event; there is none.
  Result<StoredEvent> find(std::string_view name) const;

  /// Makes the folder of an unfinished event, and that of all events. Errors: of the disk.
  Result<std::filesystem::path> begin(Utc triggered, TriggerKind trigger) const;
  /// Folder in which an event of this name is to be restored; not made.
  std::filesystem::path restoring(const std::string& name) const;
  /// Gives the folder of begin() or restoring() its name, which survives a power cut. Error also:
  /// there is such an event.
  Result<> finish(const std::filesystem::path& unfinished) const;

  /// True also for an event that may be, because its recording cannot be opened. False also for one
  /// that is not finished since its recorder ended early.
  static bool is_being_recorded(const StoredEvent& event);
  /// Error: the event is not finished, with the reason and the remedy.
  static Result<> check_finished(const StoredEvent& event);

  /// Deletes an event, also a pinned one, whole or not at all.
  Result<> remove(const StoredEvent& event) const;
  /// The same for room. False: it was pinned before it could be deleted, and stays.
  Result<bool> remove_unless_pinned(const StoredEvent& event) const;
  /// Protects a finished event from being deleted for room, or ends that; the folder of all events
  /// counts as changed.
  static Result<> set_pinned(const StoredEvent& event, bool is_pinned);

 private:
  Result<> recover(const std::filesystem::path& unfinished);
  void end_deletion(const std::filesystem::path& folder);
  void undo_deletion(const std::filesystem::path& folder);
  Result<std::filesystem::path> doom(const StoredEvent& event) const;

  std::filesystem::path root_;
  std::set<std::filesystem::path> refused_;  ///< those whose content cannot be finished
  std::set<std::filesystem::path> logged_;   ///< those that could not be finished or deleted
};

}  // namespace orbwatch::app::recorder
