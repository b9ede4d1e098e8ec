// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <chrono>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <string>
#include <vector>

#include "app/model/sink/recorded_events.h"
#include "proc/image/result.h"
#include "proc/settings/settings.h"
#include "proc/signals/alarm.h"

namespace orbwatch::app {

struct ReplayRequest {
  std::string event;
  std::uint16_t recipe = 0;  ///< number of one of the appliance's; 0: those in the recording
  std::string user;          ///< name of whoever asks; empty: there are no users
};

enum class ReplayState : std::uint8_t { None, Measuring, Done, Failed };

inline constexpr std::array kReplayStates{
    Word{"none", ReplayState::None}, Word{"measuring", ReplayState::Measuring},
    Word{"done", ReplayState::Done}, Word{"failed", ReplayState::Failed}};

/// The newest replay.
struct ReplayStatus {
  std::uint64_t number = 0;  ///< counts replays since the start
  ReplayState state = ReplayState::None;
  std::string event, user;
  std::uint16_t recipe = 0;
  std::uint64_t done = 0, of = 0;  ///< frame sets; `of` 0: not known
  std::string error;               ///< reason of a failure
};

/// Frame sets in succession with an alarm at one level.
struct RaisedAlarm {
  signals::AlarmLevel level = signals::AlarmLevel::None;
  std::string from, to;               ///< UTC of the first and of the last one
  std::uint64_t first = 0, last = 0;  ///< their numbers
};

/// An alarm as it was recorded, and as another recipe raises it.
struct ReplayedAlarm {
  std::string name;                    ///< "1, weld: hot_spot_width"
  bool was_watched = false;            ///< by the recorded recipe
  bool is_watched = false;             ///< by the other one
  bool differs = false;                ///< by more than a frame set earlier or later
  std::vector<RaisedAlarm> then, now;  ///< at most ReplayResult::kMostRaised each
  std::uint64_t more = 0;              ///< further ones
};

/// A signal of a region whose values differ from the recorded ones.
struct ReplayedSignal {
  std::string region, figure, unit;
  std::uint64_t sets = 0;                ///< frame sets in which it differs
  std::uint64_t of_jpeg = 0;             ///< those among them that JPEG explains
  double largest = signals::kNotValid;   ///< difference; NaN: a value is missing in all of them
  double recorded = signals::kNotValid;  ///< value with the largest difference
  double computed = signals::kNotValid;  ///< the other value
  std::string largest_at, first_at;      ///< UTC of the frame sets
  std::uint64_t largest_set = 0, first_set = 0;  ///< their numbers
};

struct ReplayResult {
  static constexpr std::size_t kMostRaised = 50;

  std::uint64_t number = 0;  ///< of the replay
  std::string event;
  std::uint16_t recipe = 0;
  std::uint64_t sets = 0;              ///< measured frame sets
  std::uint64_t compared = 0;          ///< those among them that are compared
  std::uint64_t without_pictures = 0;  ///< further frame sets of the recording
  std::string compared_from;           ///< UTC
  /// False: the recording is too short to leave out its beginning, where rates and delays lack
  /// what was before.
  bool is_settled = true;
  std::vector<ReplayedAlarm> alarms;
  std::vector<ReplayedSignal> signals;
};

/// Replays of the recorder's events with a recipe, one at a time, on a thread of the object. All
/// but start() and stop() are thread-safe.
class RecordedReplays {
 public:
  virtual ~RecordedReplays() = default;

  virtual void start() = 0;
  /// Cancels what is being measured.
  virtual void stop() = 0;
  virtual std::chrono::nanoseconds cpu_time() const = 0;

  /// Begins a replay, and returns its number; the result of the one before is dropped. Errors: one
  /// is running; no such event or recipe. Waits for the disk.
  virtual Result<std::uint64_t> begin(const ReplayRequest& request) = 0;
  virtual ReplayStatus status() const = 0;
  /// Error: the replay of this number is not the newest, or has no result.
  virtual Result<std::shared_ptr<const ReplayResult>> result(std::uint64_t number) const = 0;
  /// A signal that was computed. Errors: as result(); there is no such signal.
  virtual Result<RecordedCourse> course(std::uint64_t number, const std::string& region,
                                        const std::string& figure) const = 0;
  /// Cancels a replay, or drops its result. Error: it is not the newest, or has neither.
  virtual Result<> cancel(std::uint64_t number) = 0;
};

}  // namespace orbwatch::app
