#pragma once

#include <chrono>
#include <optional>

#include "proc/signals/alarm_limits.h"
#include "proc/signals/alarm_state.h"

namespace orbwatch::signals {

/// The published part of one alarm.
struct Alarm {
  AlarmState state = AlarmState::Normal;
  AlarmLevel level = AlarmLevel::None;  ///< of the signal now, after hysteresis and delays
  /// The worst level that was not acknowledged yet, or is latched; else as `level`.
  AlarmLevel announced = AlarmLevel::None;
  /// Not measured for longer than the loss delay: `level` is that of the last measurement, or
  /// NoMeasurement when that was within limits.
  bool measurement_lost = false;

  bool operator==(const Alarm&) const = default;
};

/// Whether a condition holds, and how long the evidence against that has lasted.
struct AlarmCondition {
  bool on = false;
  bool pending = false;  ///< every measurement since contradicts `on`
  std::chrono::nanoseconds pending_for{0};

  bool operator==(const AlarmCondition&) const = default;
};

/// The state of an alarm between steps.
struct AlarmMemory {
  Alarm alarm;
  AlarmCondition low_alarm, low_warning, high_warning, high_alarm;
  AlarmCondition loss;
  std::optional<std::chrono::nanoseconds> stepped_at;  ///< none: never
  bool measured = false;                               ///< at that step

  bool operator==(const AlarmMemory&) const = default;
};

/// The most time between two steps that counts towards a delay: the signal is unknown in a longer
/// gap. So step at least this often.
inline constexpr std::chrono::nanoseconds kLongestStep = std::chrono::seconds(1);

/// The inputs of one step.
struct AlarmInputs {
  std::chrono::nanoseconds now{0};  ///< of a clock that is not set; its origin does not matter
  double value = 0;                 ///< of the signal, in its unit; not finite: not measured
  bool process_active = true;
  bool is_new = true;  ///< `value` was measured since the last step
};

/// True when the process is inactive and these limits are for the active one.
inline bool is_suppressed(const AlarmLimits& limits, const AlarmInputs& inputs) {
  return limits.only_while_active && !inputs.process_active;
}

/// The alarm one step later. Reentrant, allocates nothing. For limits that passed check():
/// - A limit is reached at the value itself and left beyond the hysteresis; in between nothing
///   changes and both delays restart. Delays count the time between agreeing measurements, a gap at
///   most kLongestStep. Time that goes back counts nothing.
/// - A condition that begins on one side ends one that the off delay still holds on the other.
/// - A rise raises the alarm, which needs a new acknowledgement: from no level, from a warning to
/// an
///   alarm, to the other side, and the loss of the measurement. From alarm to warning it only
///   eases.
/// - Delays are paused while the value is not new.
/// - Without a measurement nothing begins or ends, and delays are paused; after the loss delay the
///   loss is raised, and delays restart. It ends after measurements for the off delay.
/// - While suppressed nothing is pending: an alarm is cleared, except that a latching one stays
///   latched. Delays start when the process does.
AlarmMemory step(const AlarmLimits& limits, const AlarmMemory& memory, const AlarmInputs& inputs);

/// The alarm after an operator's acknowledgement; a latched one is reset. Acknowledge before the
/// step of the same time, whose rise the operator has not seen. Reentrant.
AlarmMemory acknowledge(const AlarmLimits& limits, const AlarmMemory& memory);

/// True when `after`, one step later than `before`, needs a new acknowledgement. Reentrant.
bool is_raised(const Alarm& before, const Alarm& after);

}  // namespace orbwatch::signals
