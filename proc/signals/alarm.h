#pragma once

#include <chrono>
#include <optional>

#include "proc/signals/alarm_limits.h"
#include "proc/signals/alarm_state.h"

namespace orbwatch::signals {

/// What is known outside about one alarm.
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

/// Whether a condition counts, and how long what would change that has lasted.
struct AlarmCondition {
  bool on = false;
  bool pending = false;  ///< what would change `on` was seen, and nothing else since
  std::chrono::nanoseconds pending_for{0};

  bool operator==(const AlarmCondition&) const = default;
};

/// All that an alarm knows of its past.
struct AlarmMemory {
  Alarm alarm;
  AlarmCondition low_alarm, low_warning, high_warning, high_alarm;
  AlarmCondition loss;
  std::optional<std::chrono::nanoseconds> stepped_at;  ///< none: never
  bool measured = false;                               ///< at that step

  bool operator==(const AlarmMemory&) const = default;
};

/// No more than this of the time between two steps counts towards a delay: nobody knows what the
/// signal did in a longer gap. So step at least this often.
inline constexpr std::chrono::nanoseconds kLongestStep = std::chrono::seconds(1);

/// One moment.
struct AlarmInputs {
  std::chrono::nanoseconds now{0};  ///< of a clock that is not set; its origin does not matter
  double value = 0;                 ///< of the signal, in its unit; not finite: not measured
  bool process_active = true;
  bool is_new = true;  ///< `value` was measured since the last step
};

/// True when this moment cannot be an alarm of these limits.
inline bool is_suppressed(const AlarmLimits& limits, const AlarmInputs& inputs) {
  return limits.only_while_active && !inputs.process_active;
}

/// The alarm one moment later. Reentrant, allocates nothing. For limits that passed check():
/// - A limit is reached at the value itself and left beyond the hysteresis; in between nothing
///   changes and both delays start anew. Delays count the time between measurements that say the
///   same. Time that goes back counts nothing, a gap at most kLongestStep.
/// - What begins on one side ends what the off delay still held on the other.
/// - A rise is raised, so it needs to be acknowledged again: from no level, from a warning to an
///   alarm, to the other side, and the loss of the measurement. From alarm to warning it only
///   eases.
/// - While the value is not new delays stand still: what was measured once says nothing of later.
/// - Without a measurement nothing begins or ends, and delays stand still; after the loss delay
///   that is raised, and delays start anew. It ends when there were values for the off delay.
/// - While suppressed nothing is pending: what stood is cleared, except that a latching alarm stays
///   latched. Delays start when the process does.
AlarmMemory step(const AlarmLimits& limits, const AlarmMemory& memory, const AlarmInputs& inputs);

/// The alarm once an operator has acknowledged what it is in `memory`; a latched one is reset.
/// Acknowledge before the step of the same moment: what rises in it was not seen yet. Reentrant.
AlarmMemory acknowledge(const AlarmLimits& limits, const AlarmMemory& memory);

/// True when `after`, one step later than `before`, has something to acknowledge that `before` had
/// not. Reentrant.
bool is_raised(const Alarm& before, const Alarm& after);

}  // namespace orbwatch::signals
