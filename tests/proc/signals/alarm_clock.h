// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <chrono>
#include <limits>

#include "proc/signals/alarm.h"

namespace orbwatch::signals::tests {

inline constexpr double kNoValue = std::numeric_limits<double>::quiet_NaN();

/// One alarm with a clock that the test sets.
class AlarmClock {
 public:
  explicit AlarmClock(const AlarmLimits& limits) : limits_(limits) {}

  /// Advances the clock and steps.
  const Alarm& after(std::chrono::nanoseconds time, double value, bool is_new = true) {
    now_ += time;
    memory_ = step(limits_, memory_, {now_, value, active_, is_new});
    return memory_.alarm;
  }
  const Alarm& acknowledge() {
    memory_ = signals::acknowledge(limits_, memory_);
    return memory_.alarm;
  }
  void set_active(bool active) { active_ = active; }

  const Alarm& alarm() const { return memory_.alarm; }
  AlarmState state() const { return memory_.alarm.state; }
  AlarmLevel level() const { return memory_.alarm.level; }

 private:
  AlarmLimits limits_;
  AlarmMemory memory_;
  std::chrono::nanoseconds now_ = std::chrono::hours(5);
  bool active_ = true;
};

}  // namespace orbwatch::signals::tests
