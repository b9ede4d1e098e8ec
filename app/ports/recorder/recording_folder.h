// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <chrono>
#include <cstdint>
#include <filesystem>
#include <functional>
#include <optional>
#include <set>
#include <string>
#include <vector>

#include "app/ports/recorder/events/event_folder.h"
#include "app/ports/recorder/events/event_index.h"
#include "app/ports/recorder/recorder_settings.h"
#include "hal/clock.h"
#include "proc/image/result.h"

namespace orbwatch::app::recorder {

/// A log in the folder.
struct Recording {
  std::filesystem::path file;
  std::uint64_t bytes = 0;
};

/// The folder of recordings, logs and events, kept within its limits; other files in it are not
/// touched. The folder is the truth; it is read again when names in it changed. Thread-bound; waits
/// for the disk.
class RecordingFolder {
 public:
  explicit RecordingFolder(const RecorderSettings& settings)
      : settings_(settings), events_(settings.folder), index_(settings.folder) {}

  /// Creates the folders and finishes recordings that an earlier run did not end. What the disk
  /// prevents is logged once and tried again by the next call; a recording whose content is refused
  /// stays. Errors: the folder; a full disk, for which they wait.
  Result<> prepare();

  /// Logs, the oldest first by their names.
  Result<std::vector<Recording>> list() const;

  /// Name for a recording that begins at `utc`: log-20261128T092200Z.mcap, with a number behind it
  /// if there is one already, as after the clock was set back.
  std::filesystem::path name_for(std::chrono::system_clock::time_point utc) const;

  /// Deletes events above the limit of age, a few at a time, so that recording does not wait, and
  /// only once UTC has followed the steady clock `now` for an hour; then the oldest logs and events
  /// until the limits of size hold. Names more than a day in the future are from before the clock
  /// was set back, and count as older than all others. The log `current`, events that are pinned
  /// and those that are being recorded stay. Beside pinned events the others have at least a
  /// quarter of the limit, and the newest of them is deleted for the reserve only. Returns the
  /// number of what is deleted. Without a change in the folder and with room this costs the same
  /// however many there are. A recording that cannot be deleted is logged once and stays. Errors:
  /// the folder; the disk has less than the reserve although there is none that can be deleted.
  Result<int> make_room(const std::filesystem::path& current,
                        std::chrono::system_clock::time_point utc,
                        hal::TimePoint now = hal::Clock::now());

  /// Reason why limit_mib may not hold: pinned events take more than three quarters of it; empty:
  /// it holds. As of the last make_room(), which logs the change.
  const std::string& pin_fault() const { return pin_fault_; }

 private:
  /// A log or an event that may be deleted.
  struct Deletable {
    std::string begun;  ///< by its name
    std::uint64_t bytes = 0;
    std::function<Result<bool>()> remove;  ///< false: it must stay now
  };
  Result<> update(const std::filesystem::path& current);
  bool is_removed(const std::string& name, const Result<bool>& done);
  bool is_clock_settled(std::chrono::system_clock::time_point utc, hal::TimePoint now);
  int remove_old(std::chrono::system_clock::time_point utc);
  void check_pins();
  Result<int> remove_for_room(std::chrono::system_clock::time_point utc);
  std::uint64_t limit() const;
  std::uint64_t room() const;
  std::uint64_t bytes() const;
  std::vector<Deletable> deletable(std::chrono::system_clock::time_point utc) const;
  Result<bool> remove(const StoredEvent& listed) const;

  const RecorderSettings settings_;
  EventFolder events_;
  EventIndex index_;
  std::optional<std::filesystem::file_time_type> changed_;  ///< when logs_ was read
  std::vector<Recording> logs_;
  std::filesystem::path current_;  ///< the log that grows
  std::uint64_t still_bytes_ = 0;  ///< of recordings that neither grow nor are pinned
  std::uint64_t pinned_bytes_ = 0;
  std::string pin_fault_;
  std::optional<std::chrono::nanoseconds> clock_offset_;  ///< UTC minus the steady clock
  hal::TimePoint settled_since_{};                        ///< when the offset was first measured
  std::set<std::filesystem::path> refused_;               ///< logs whose content cannot be finished
  std::set<std::filesystem::path> unfinished_;  ///< those that could not be finished, logged once
  std::set<std::string> undeletable_;           ///< those that could not be deleted, logged once
};

}  // namespace orbwatch::app::recorder
