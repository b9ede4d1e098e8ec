// SPDX-License-Identifier: Apache-2.0
#include "app/daemon/replay/replay_findings.h"

#include <algorithm>
#include <cmath>
#include <string_view>

#include "app/ports/recorder/recorded_utc.h"
#include "proc/signals/alarm_board.h"

namespace orbwatch::app::daemon {
namespace {

using recorder::ComponentFigures;
using recorder::Figure;
using signals::AlarmLevel;

/// Those of two recipes; a recording of any origin may name more.
constexpr std::size_t kMostAlarms = 2 * signals::kMaxAlarms;

/// Level of an alarm in a state of any origin; a number without a level is none.
AlarmLevel level_in(const ComponentFigures& alarm) {
  const auto found = std::ranges::find(alarm.figures, "level", &Figure::name);
  if (found == alarm.figures.end()) return AlarmLevel::None;
  constexpr auto kLast = static_cast<double>(AlarmLevel::NoMeasurement);
  const bool is_level = found->value >= 0 && found->value <= kLast;
  return is_level ? static_cast<AlarmLevel>(static_cast<std::uint8_t>(found->value))
                  : AlarmLevel::None;
}

/// A difference between a number and none counts less than any between numbers.
bool is_larger(double difference, double than) {
  return !std::isnan(difference) && (std::isnan(than) || difference > than);
}

}  // namespace

ReplayFindings::ReplayFindings(JpegQualities qualities)
    : comparison_(0, std::move(qualities),
                  [this](const Difference& difference) { add_difference(difference); }) {}

void ReplayFindings::add(const ReplayedSet& set, bool is_compared) {
  add_alarms(set, true);
  add_alarms(set, false);
  if (!is_compared) return;
  for (const ComponentFigures& component : set.computed.components) {
    if (component.kind != "region") continue;
    for (const Figure& figure : component.figures) {
      units_.try_emplace({component.name, figure.name}, figure.unit);
    }
  }
  comparison_.add(set.utc, set.recorded, set.computed);
}

void ReplayFindings::add_alarms(const ReplayedSet& set, bool is_recorded) {
  for (const ComponentFigures& component : (is_recorded ? set.recorded : set.computed).components) {
    if (component.kind != "alarm") continue;
    if (alarms_.size() == kMostAlarms && !alarms_.contains(component.name)) continue;
    WatchedAlarm& watched = alarms_[component.name];
    watched.alarm.name = component.name;
    (is_recorded ? watched.alarm.was_watched : watched.alarm.is_watched) = true;
    add_level(watched, set, is_recorded, level_in(component));
  }
}

void ReplayFindings::add_level(WatchedAlarm& watched, const ReplayedSet& set, bool is_recorded,
                               AlarmLevel level) {
  Before& before = is_recorded ? watched.recorded : watched.computed;
  std::vector<RaisedAlarm>& raised = is_recorded ? watched.alarm.then : watched.alarm.now;
  const bool is_new = level != before.level;
  before.level = level;
  if (level == AlarmLevel::None) return;
  const std::string utc = recorder::utc_text_at(set.utc);
  const std::uint64_t number = set.recorded.frame_set;
  if (is_new) {
    before.is_listed = raised.size() < ReplayResult::kMostRaised;
    if (before.is_listed) {
      raised.push_back({level, utc, utc, number, number});
    } else {
      ++watched.alarm.more;
    }
  }
  if (!before.is_listed) return;
  raised.back().to = utc;
  raised.back().last = number;
}

void ReplayFindings::add_difference(const Difference& difference) {
  if (difference.kind == "alarm") {
    // States also depend on acknowledgements, and on what was latched before the recording.
    const auto alarm = alarms_.find(difference.name);
    if (difference.figure == "level" && alarm != alarms_.end()) alarm->second.alarm.differs = true;
    return;
  }
  ReplayedSignal& signal = signals_[{difference.name, difference.figure}];
  if (signal.sets++ == 0) {
    signal.region = difference.name;
    signal.figure = difference.figure;
    signal.first_at = recorder::utc_text_at(difference.utc);
    signal.first_set = difference.frame_set;
  }
  signal.of_jpeg += difference.is_of_jpeg ? 1 : 0;
  const double size = std::abs(difference.recorded - difference.computed);
  if (signal.sets > 1 && !is_larger(size, signal.largest)) return;
  signal.largest = size;
  signal.recorded = difference.recorded;
  signal.computed = difference.computed;
  signal.largest_at = recorder::utc_text_at(difference.utc);
  signal.largest_set = difference.frame_set;
}

void ReplayFindings::finish(ReplayResult& result) {
  result.compared = comparison_.finish().sets;
  for (auto& [name, watched] : alarms_) {
    ReplayedAlarm& alarm = watched.alarm;
    // An alarm of one recipe alone is not compared set by set.
    if (alarm.was_watched != alarm.is_watched) {
      alarm.differs = !alarm.then.empty() || !alarm.now.empty();
    }
    result.alarms.push_back(std::move(alarm));
  }
  for (auto& [key, signal] : signals_) {
    signal.unit = units_[key];
    result.signals.push_back(std::move(signal));
  }
}

}  // namespace orbwatch::app::daemon
