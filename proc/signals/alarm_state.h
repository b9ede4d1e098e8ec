#pragma once

#include <cstdint>
#include <string_view>

namespace orbwatch::signals {

/// The state of an alarm, after ISA-18.2 / IEC 62682 (A to F and H of their state
/// diagram). The standard's reset of a latched alarm is its acknowledgement once the condition has
/// gone. The numbers go to PLC and controller: append, never renumber.
enum class AlarmState : std::uint8_t {
  Normal = 0,
  Unacknowledged = 1,
  Acknowledged = 2,
  ReturnedUnacknowledged = 3,
  LatchedUnacknowledged = 4,
  LatchedAcknowledged = 5,
  SuppressedByDesign = 6,
};

/// How far, and to which side, a signal is out of its limits. The numbers go to PLC and controller:
/// append, never renumber.
enum class AlarmLevel : std::uint8_t {
  None = 0,
  LowAlarm = 1,
  LowWarning = 2,
  HighWarning = 3,
  HighAlarm = 4,
  NoMeasurement = 5,  ///< within the limits when it was last measured
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

/// 0: none, 1: a warning or no measurement, 2: an alarm.
constexpr int severity(AlarmLevel level) {
  switch (level) {
    case AlarmLevel::None:
      return 0;
    case AlarmLevel::LowWarning:
    case AlarmLevel::HighWarning:
    case AlarmLevel::NoMeasurement:
      return 1;
    case AlarmLevel::LowAlarm:
    case AlarmLevel::HighAlarm:
      return 2;
  }
  return 0;
}

}  // namespace orbwatch::signals
