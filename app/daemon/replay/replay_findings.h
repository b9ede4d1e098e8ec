// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <map>
#include <string>
#include <utility>
#include <vector>

#include "app/daemon/replay/comparison.h"
#include "app/daemon/replay/replay.h"
#include "app/model/sink/recorded_replays.h"
#include "app/ports/recorder/messages.h"

namespace orbwatch::app::daemon {

/// Collects what a replay finds, for people: alarms then and now, and the signals that differ.
/// Bounded by the alarms and signals of recipes, however long the recording is. Thread-bound.
class ReplayFindings {
 public:
  explicit ReplayFindings(JpegQualities qualities);
  ReplayFindings(const ReplayFindings&) = delete;
  ReplayFindings& operator=(const ReplayFindings&) = delete;

  /// Adds the alarms of a frame set, and compares it unless `is_compared` is false.
  void add(const ReplayedSet& set, bool is_compared);
  /// Ends the comparison: moves `alarms`, `signals` and `compared` into the result.
  void finish(ReplayResult& result);

 private:
  /// An alarm in the set before, as recorded or as computed.
  struct Before {
    signals::AlarmLevel level = signals::AlarmLevel::None;
    bool is_listed = false;  ///< false: beyond ReplayResult::kMostRaised
  };
  struct WatchedAlarm {
    ReplayedAlarm alarm;
    Before recorded, computed;
  };

  void add_difference(const Difference& difference);
  void add_alarms(const ReplayedSet& set, bool is_recorded);
  static void add_level(WatchedAlarm& watched, const ReplayedSet& set, bool is_recorded,
                        signals::AlarmLevel level);

  Comparison comparison_;
  std::map<std::string, WatchedAlarm> alarms_;                             ///< by name
  std::map<std::pair<std::string, std::string>, ReplayedSignal> signals_;  ///< by region and figure
  std::map<std::pair<std::string, std::string>, std::string> units_;       ///< likewise
};

}  // namespace orbwatch::app::daemon
