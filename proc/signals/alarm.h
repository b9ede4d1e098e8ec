// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <chrono>
#include <cstdint>
#include <optional>
#include <string_view>

#include "proc/signals/alarm_limits.h"

namespace orbwatch::signals {

/// The state of an alarm, after ISA-18.2 / IEC 62682 (A to F and H of their state diagram). The
/// standard's reset of a latched alarm is its acknowledgement once the condition has ended. The
/// numbers go to PLC and controller: append, never renumber.
enum class AlarmState : std::uint8_t {
  Normal = 0,
  Unacknowledged = 1,
  Acknowledged = 2,
  ReturnedUnacknowledged = 3,
  LatchedUnacknowledged = 4,
  LatchedAcknowledged = 5,
  SuppressedByDesign = 6,
};

/// Side and severity by which a signal exceeds its limits. The numbers go to PLC and controller:
/// append, never renumber.
enum class AlarmLevel : std::uint8_t {
  None = 0,
  LowAlarm = 1,
  LowWarning = 2,
  HighWarning = 3,
  HighAlarm = 4,
  NoMeasurement = 5,  ///< for longer than the loss delay
};

/// An event of an alarm. The numbers go to the controller: append, never renumber.
enum class AlarmEventKind : std::uint8_t {
  Raised = 0,
  Eased = 1,
  Cleared = 2,
  Acknowledged = 3,
  Suppressed = 4,
};

/// The operator's text for a state. Empty for a number without a state.
constexpr std::string_view operator_text(AlarmState state) {
  switch (state) {
    case AlarmState::Normal:
      return "normal";
    case AlarmState::Unacknowledged:
      return "in alarm, not acknowledged";
    case AlarmState::Acknowledged:
      return "in alarm, acknowledged";
    case AlarmState::ReturnedUnacknowledged:
      return "returned to normal, not acknowledged";
    case AlarmState::LatchedUnacknowledged:
      return "latched after its cause has gone, not acknowledged";
    case AlarmState::LatchedAcknowledged:
      return "latched after its cause has gone: acknowledge again to reset";
    case AlarmState::SuppressedByDesign:
      return "suppressed while the process is not active";
  }
  return {};
}

/// The operator's text for a level. Empty for a number without a level.
constexpr std::string_view operator_text(AlarmLevel level) {
  switch (level) {
    case AlarmLevel::None:
      return "within limits";
    case AlarmLevel::LowAlarm:
      return "low alarm";
    case AlarmLevel::LowWarning:
      return "low warning";
    case AlarmLevel::HighWarning:
      return "high warning";
    case AlarmLevel::HighAlarm:
      return "high alarm";
    case AlarmLevel::NoMeasurement:
      return "no measurement";
  }
  return {};
}

/// The operator's text for an event. Empty for a number without an event.
constexpr std::string_view operator_text(AlarmEventKind kind) {
  switch (kind) {
    case AlarmEventKind::Raised:
      return "raised";
    case AlarmEventKind::Eased:
      return "eased from alarm to warning";
    case AlarmEventKind::Cleared:
      return "cleared";
    case AlarmEventKind::Acknowledged:
      return "acknowledged";
    case AlarmEventKind::Suppressed:
      return "suppressed";
  }
  return {};
}

/// True while the condition holds or the alarm is latched: the bit that a PLC acts on.
constexpr bool is_active(AlarmState state) {
  return state == AlarmState::Unacknowledged || state == AlarmState::Acknowledged ||
         state == AlarmState::LatchedUnacknowledged || state == AlarmState::LatchedAcknowledged;
}

/// True in states that an acknowledgement changes.
constexpr bool awaits_acknowledgement(AlarmState state) {
  return state == AlarmState::Unacknowledged || state == AlarmState::ReturnedUnacknowledged ||
         state == AlarmState::LatchedUnacknowledged || state == AlarmState::LatchedAcknowledged;
}

/// Severity of a level, 0: none, 1: a warning or no measurement, 2: an alarm.
constexpr int severity(AlarmLevel level) {
  if (level == AlarmLevel::None) return 0;
  return level == AlarmLevel::LowAlarm || level == AlarmLevel::HighAlarm ? 2 : 1;
}

/// The published part of one alarm.
struct Alarm {
  AlarmState state = AlarmState::Normal;
  AlarmLevel level = AlarmLevel::None;  ///< the signal's present level, after hysteresis and delays
  /// The worst level that has not been acknowledged yet, is latched, or was present when the
  /// measurement was lost and has not been acknowledged since; else `level`.
  AlarmLevel announced = AlarmLevel::None;
  /// True if `level` is NoMeasurement.
  bool measurement_lost = false;

  bool operator==(const Alarm&) const = default;
};

/// State of a condition, and duration of the evidence against that state.
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
  std::optional<std::chrono::nanoseconds> stepped_at;  ///< none before the first step
  bool measured = false;                               ///< at that step

  bool operator==(const AlarmMemory&) const = default;
};

/// The most time between two steps that counts towards a delay: the signal is unknown in a longer
/// gap. So step at least this often.
inline constexpr std::chrono::nanoseconds kLongestStep = std::chrono::seconds(1);

/// The inputs of one step.
struct AlarmInputs {
  std::chrono::nanoseconds now{0};  ///< time of a clock that is never set; its origin is arbitrary
  double value = 0;                 ///< the signal's value in its unit; not finite: not measured
  bool process_active = true;
  bool is_new = true;  ///< true if `value` was measured since the last step
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
///   an alarm, to the other side, and the loss of the measurement. From alarm to warning it only
///   eases.
/// - Delays are paused while the value is not new.
/// - Without a measurement nothing begins or ends, and delays are paused. After the loss delay the
///   loss is raised in place of the previous level, which stays announced until it is acknowledged,
///   and delays restart. It ends after measurements for the off delay, or when a limit's condition
///   begins.
/// - While suppressed nothing is pending: an alarm is cleared, except that a latching one stays
///   latched. Delays start when the process does.
AlarmMemory step(const AlarmLimits& limits, const AlarmMemory& memory, const AlarmInputs& inputs);

/// The alarm after an operator's acknowledgement; a latched one is reset. Acknowledge before the
/// step of the same time, whose rise the operator has not seen. Reentrant.
AlarmMemory acknowledge(const AlarmLimits& limits, const AlarmMemory& memory);

/// True when `after`, one step later than `before`, needs a new acknowledgement. Reentrant.
bool is_raised(const Alarm& before, const Alarm& after);

}  // namespace orbwatch::signals
