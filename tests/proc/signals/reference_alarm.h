// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <array>
#include <chrono>
#include <cmath>
#include <vector>

#include "proc/signals/alarm.h"

namespace orbwatch::signals::tests {

/// An alarm by its definition: keeps every moment since the process became active, searches back
/// through them at each step, and derives the state from three facts about the operator.
class ReferenceAlarm {
 public:
  explicit ReferenceAlarm(const AlarmLimits& limits) : limits_(limits) {}

  void acknowledge() {
    if (standing()) {
      if (!limits_.latching) worst_ = {level_};
    } else {
      latched_ = false;
      worst_.clear();
    }
    unseen_ = false;
  }

  void step(std::chrono::nanoseconds now, double value, bool active) {
    suppressed_ = limits_.only_while_active && !active;
    if (suppressed_) {
      story_.clear();
      conditions_ = {};
      level_ = AlarmLevel::None;
      if (!latched_) {
        unseen_ = false;
        worst_.clear();
      }
      return;
    }
    story_.push_back({now, value, false});
    const bool was_lost = conditions_[kLoss].on;
    if (limits_.loss_delay) reconsider(kLoss);
    const bool lost = conditions_[kLoss].on;
    if (std::isfinite(value)) {
      for (int i = 0; i < kLoss; ++i) reconsider(i);
      for (int i = 0; i < kLoss; ++i) end_the_other_side_of(i);
    } else if (lost) {
      story_.back().forgets = true;
      for (int i = 0; i < kLoss; ++i) end(i);
    }
    for (int i = 0; i < kLoss; ++i) {
      if (conditions_[static_cast<std::size_t>(i)].on) end(kLoss);
    }
    judge(lost && !was_lost);
  }

  Alarm alarm() const {
    const AlarmLevel announced = worst_.empty() ? AlarmLevel::None : *worst();
    return {state(), level_, announced, conditions_[kLoss].on};
  }

 private:
  struct Moment {
    std::chrono::nanoseconds time;
    double value;
    bool forgets;  ///< nothing before it counts
  };
  struct Condition {
    bool on = false;
    std::size_t from = 0;  ///< the first moment that counts
  };
  enum class Says { Yes, No, Neither, Nothing };
  static constexpr int kLoss = 4;

  Says says(int condition, double value) const {
    if (condition == kLoss) return std::isfinite(value) ? Says::No : Says::Yes;
    if (!std::isfinite(value)) return Says::Nothing;
    const std::array all{limits_.low_alarm, limits_.low_warning, limits_.high_warning,
                         limits_.high_alarm};
    const auto& limit = all[static_cast<std::size_t>(condition)];
    if (!limit) return Says::No;
    if (condition < 2) {
      if (value <= *limit) return Says::Yes;
      return value > *limit + limits_.hysteresis ? Says::No : Says::Neither;
    }
    if (value >= *limit) return Says::Yes;
    return value < *limit - limits_.hysteresis ? Says::No : Says::Neither;
  }

  void reconsider(int index) {
    Condition& condition = conditions_[static_cast<std::size_t>(index)];
    const Says wanted = condition.on ? Says::No : Says::Yes;
    const std::size_t last = story_.size() - 1;
    if (says(index, story_[last].value) != wanted) return;
    std::size_t first = last;
    for (std::size_t k = last + 1; k-- > condition.from;) {
      const Says said = says(index, story_[k].value);
      if (said == wanted) {
        first = k;
      } else if (said != Says::Nothing || story_[k].forgets) {
        break;
      }
    }
    const auto on_delay = index == kLoss ? *limits_.loss_delay : limits_.on_delay;
    if (counted(first, last, index == kLoss) < (condition.on ? limits_.off_delay : on_delay)) {
      return;
    }
    condition = {!condition.on, last + 1};
  }

  std::chrono::nanoseconds counted(std::size_t first, std::size_t last, bool also_lost) const {
    std::chrono::nanoseconds sum{0};
    for (std::size_t k = first; k < last; ++k) {
      const bool measured = std::isfinite(story_[k].value) && std::isfinite(story_[k + 1].value);
      if (!measured && !also_lost) continue;
      sum += std::clamp(story_[k + 1].time - story_[k].time, std::chrono::nanoseconds(0),
                        kLongestStep);
    }
    return sum;
  }

  void end_the_other_side_of(int index) {
    if (!conditions_[static_cast<std::size_t>(index)].on) return;
    if (says(index, story_.back().value) != Says::Yes) return;
    const std::size_t other = index < 2 ? 2 : 0;
    end(static_cast<int>(other));
    end(static_cast<int>(other + 1));
  }

  void end(int condition) {
    Condition& ended = conditions_[static_cast<std::size_t>(condition)];
    if (ended.on) ended = {false, story_.size()};
  }

  AlarmLevel level() const {
    if (conditions_[0].on) return AlarmLevel::LowAlarm;
    if (conditions_[3].on) return AlarmLevel::HighAlarm;
    if (conditions_[1].on) return AlarmLevel::LowWarning;
    if (conditions_[2].on) return AlarmLevel::HighWarning;
    return conditions_[kLoss].on ? AlarmLevel::NoMeasurement : AlarmLevel::None;
  }

  void judge(bool lost_now) {
    const AlarmLevel before = level_;
    level_ = level();
    const bool eases = (before == AlarmLevel::HighAlarm && level_ == AlarmLevel::HighWarning) ||
                       (before == AlarmLevel::LowAlarm && level_ == AlarmLevel::LowWarning);
    if (lost_now || (standing() && level_ != before && !eases)) {
      const bool lost = level_ == AlarmLevel::NoMeasurement;
      if (!unseen_ && !limits_.latching && !lost) worst_.clear();
      worst_.push_back(level_);
      unseen_ = true;
      latched_ = limits_.latching;
    } else if (!unseen_ && !latched_) {
      worst_ = {level_};
    }
  }

  /// The worst level; the newest of equal ones.
  std::vector<AlarmLevel>::const_iterator worst() const {
    return std::max_element(worst_.begin(), worst_.end(),
                            [](AlarmLevel a, AlarmLevel b) { return severity(a) <= severity(b); });
  }

  bool standing() const { return level_ != AlarmLevel::None; }

  AlarmState state() const {
    if (standing()) return unseen_ ? AlarmState::Unacknowledged : AlarmState::Acknowledged;
    if (latched_) {
      return unseen_ ? AlarmState::LatchedUnacknowledged : AlarmState::LatchedAcknowledged;
    }
    if (suppressed_) return AlarmState::SuppressedByDesign;
    return unseen_ ? AlarmState::ReturnedUnacknowledged : AlarmState::Normal;
  }

  AlarmLimits limits_;
  std::vector<Moment> story_;
  std::array<Condition, 5> conditions_;
  AlarmLevel level_ = AlarmLevel::None;
  std::vector<AlarmLevel> worst_;  ///< levels that count towards the announced one
  bool unseen_ = false;
  bool latched_ = false;
  bool suppressed_ = false;
};

}  // namespace orbwatch::signals::tests
