// SPDX-License-Identifier: Apache-2.0
#include "proc/signals/alarm.h"

#include <algorithm>
#include <cmath>

namespace orbwatch::signals {
namespace {

using std::chrono::nanoseconds;

/// Evidence of one moment for or against a condition.
enum class Evidence : std::uint8_t { Holds, Between, Ended };

/// `outward`: 1 for a high limit, -1 for a low one.
Evidence evidence(const std::optional<double>& limit, double outward, double hysteresis,
                  double value) {
  if (!limit) return Evidence::Ended;
  const double beyond = outward * (value - *limit);
  if (beyond >= 0) return Evidence::Holds;
  return beyond < -hysteresis ? Evidence::Ended : Evidence::Between;
}

struct Delays {
  nanoseconds on;
  nanoseconds off;
};

/// The condition `elapsed` after its last update.
AlarmCondition advanced(const AlarmCondition& before, Evidence seen, nanoseconds elapsed,
                        const Delays& delays) {
  const bool changes = seen == (before.on ? Evidence::Ended : Evidence::Holds);
  if (!changes) return {before.on};
  const nanoseconds lasted = before.pending ? before.pending_for + elapsed : nanoseconds(0);
  if (lasted >= (before.on ? delays.off : delays.on)) return {!before.on};
  return {before.on, true, lasted};
}

nanoseconds counted_time(const AlarmMemory& memory, nanoseconds now) {
  if (!memory.stepped_at || now < *memory.stepped_at) return nanoseconds(0);
  return std::min(now - *memory.stepped_at, kLongestStep);
}

/// `elapsed`: time since the last step, 0 when that had no measurement.
void watch_limits(const AlarmLimits& limits, double value, nanoseconds elapsed,
                  AlarmMemory& memory) {
  const Delays delays{limits.on_delay, limits.off_delay};
  bool low_holds = false;
  bool high_holds = false;
  const auto watch = [&](AlarmCondition& condition, const std::optional<double>& limit,
                         double outward, bool& holds) {
    const Evidence seen = evidence(limit, outward, limits.hysteresis, value);
    condition = advanced(condition, seen, elapsed, delays);
    holds = holds || (condition.on && seen == Evidence::Holds);
  };
  watch(memory.low_alarm, limits.low_alarm, -1, low_holds);
  watch(memory.low_warning, limits.low_warning, -1, low_holds);
  watch(memory.high_warning, limits.high_warning, 1, high_holds);
  watch(memory.high_alarm, limits.high_alarm, 1, high_holds);
  if (low_holds) memory.high_warning = memory.high_alarm = {};
  if (high_holds) memory.low_warning = memory.low_alarm = {};
}

void end_limits(AlarmMemory& memory) {
  memory.low_alarm = memory.low_warning = memory.high_warning = memory.high_alarm = {};
}

bool is_beyond_limits(const AlarmMemory& memory) {
  return memory.low_alarm.on || memory.low_warning.on || memory.high_warning.on ||
         memory.high_alarm.on;
}

/// At most one side is on.
AlarmLevel level_of(const AlarmMemory& memory) {
  if (memory.low_alarm.on) return AlarmLevel::LowAlarm;
  if (memory.high_alarm.on) return AlarmLevel::HighAlarm;
  if (memory.low_warning.on) return AlarmLevel::LowWarning;
  if (memory.high_warning.on) return AlarmLevel::HighWarning;
  return memory.loss.on ? AlarmLevel::NoMeasurement : AlarmLevel::None;
}

int side(AlarmLevel level) {
  if (level == AlarmLevel::LowAlarm || level == AlarmLevel::LowWarning) return -1;
  return level == AlarmLevel::HighWarning || level == AlarmLevel::HighAlarm ? 1 : 0;
}

/// The state after the condition of an alarm in `state` has ended.
AlarmState returned(AlarmState state, bool latching) {
  if (state == AlarmState::Unacknowledged) {
    return latching ? AlarmState::LatchedUnacknowledged : AlarmState::ReturnedUnacknowledged;
  }
  if (state == AlarmState::Acknowledged && latching) return AlarmState::LatchedAcknowledged;
  return state == AlarmState::Acknowledged || state == AlarmState::SuppressedByDesign
             ? AlarmState::Normal
             : state;
}

Alarm judged(const Alarm& before, AlarmLevel level, bool measurement_lost, bool latching) {
  Alarm after = before;
  after.level = level;
  after.measurement_lost = measurement_lost;
  if (is_raised(before, after)) {
    // The loss of a measurement never lowers the announced level.
    const bool seen =
        before.state == AlarmState::Acknowledged && !latching && level != AlarmLevel::NoMeasurement;
    if (seen || severity(level) >= severity(before.announced)) after.announced = level;
    after.state = AlarmState::Unacknowledged;
  } else if (level == AlarmLevel::None) {
    after.state = returned(before.state, latching);
    if (after.state == AlarmState::Normal) after.announced = AlarmLevel::None;
  } else if (after.state == AlarmState::Acknowledged && !latching) {
    after.announced = level;
  }
  return after;
}

Alarm suppressed(const Alarm& before, bool latching) {
  const AlarmState state = returned(before.state, latching);
  if (is_active(state)) return {state, AlarmLevel::None, before.announced, false};
  return {AlarmState::SuppressedByDesign, AlarmLevel::None, AlarmLevel::None, false};
}

}  // namespace

AlarmMemory step(const AlarmLimits& limits, const AlarmMemory& memory, const AlarmInputs& inputs) {
  AlarmMemory next;
  next.measured = std::isfinite(inputs.value);
  const bool is_counted = inputs.is_new || !next.measured;
  next.stepped_at = is_counted ? inputs.now : memory.stepped_at;
  if (is_suppressed(limits, inputs)) {
    next.alarm = suppressed(memory.alarm, limits.latching);
    return next;
  }
  next.low_alarm = memory.low_alarm;
  next.low_warning = memory.low_warning;
  next.high_warning = memory.high_warning;
  next.high_alarm = memory.high_alarm;
  const nanoseconds elapsed = is_counted ? counted_time(memory, inputs.now) : nanoseconds(0);
  if (limits.loss_delay) {
    next.loss = advanced(memory.loss, next.measured ? Evidence::Ended : Evidence::Holds, elapsed,
                         {*limits.loss_delay, limits.off_delay});
  }
  if (next.measured) {
    watch_limits(limits, inputs.value, memory.measured ? elapsed : nanoseconds(0), next);
  } else if (next.loss.on) {
    end_limits(next);
  }
  if (next.loss.on && is_beyond_limits(next)) next.loss = {};
  next.alarm = judged(memory.alarm, level_of(next), next.loss.on, limits.latching);
  return next;
}

AlarmMemory acknowledge(const AlarmLimits& limits, const AlarmMemory& memory) {
  AlarmMemory next = memory;
  Alarm& alarm = next.alarm;
  if (alarm.state == AlarmState::Unacknowledged) {
    alarm.state = AlarmState::Acknowledged;
    if (!limits.latching) alarm.announced = alarm.level;
  } else if (awaits_acknowledgement(alarm.state)) {
    alarm.state = AlarmState::Normal;
    alarm.announced = AlarmLevel::None;
  }
  return next;
}

bool is_raised(const Alarm& before, const Alarm& after) {
  if (after.measurement_lost && !before.measurement_lost) return true;
  if (after.level == AlarmLevel::None || after.level == before.level) return false;
  return severity(after.level) > severity(before.level) || side(after.level) != side(before.level);
}

}  // namespace orbwatch::signals
