// SPDX-License-Identifier: Apache-2.0
#include "app/model/status/condition.h"

#include <algorithm>

namespace orbwatch::app {
namespace {

Severity severity_of(signals::AlarmLevel level) {
  return static_cast<Severity>(signals::severity(level));
}

/// An unwatched figure is not a fault.
Severity severity_of(WatchLevel level) {
  if (level == WatchLevel::Alarm) return Severity::Alarm;
  return level == WatchLevel::Warning ? Severity::Warning : Severity::None;
}

/// Learning and darkness pass.
Severity severity_of(AlignmentLevel level) {
  const bool is_warning =
      level == AlignmentLevel::Warning || level == AlignmentLevel::NotRegistered;
  if (is_warning) return Severity::Warning;
  return level == AlignmentLevel::Alarm ? Severity::Alarm : Severity::None;
}

Severity severity_of(OutlineState state) {
  return state == OutlineState::NotAligned ? Severity::Warning : Severity::None;
}

Severity severity_of(SystemState state) {
  switch (state) {
    case SystemState::Starting:
      return Severity::Unknown;
    case SystemState::Running:
    case SystemState::Stopped:
      return Severity::None;
    case SystemState::Degraded:
      return Severity::Warning;
    case SystemState::Fault:
      return Severity::Alarm;
  }
  return Severity::Unknown;
}

constexpr unsigned kUnderVoltage = static_cast<unsigned>(Throttling::UnderVoltage);

/// Bits of Throttling that apply now; 0 also where the board has no source of them.
unsigned causes_now(const Health& health) {
  constexpr unsigned kNow = (1U << kSincePowerOn) - 1, kAll = 255;
  if (!signals::is_valid(health.throttling)) return 0;
  return static_cast<unsigned>(std::clamp(health.throttling, 0.0, double{kAll})) & kNow;
}

/// Throttled for any other reason than the state of the supply alone.
bool is_slowed_down(const Health& health) { return (causes_now(health) & ~kUnderVoltage) != 0; }

}  // namespace

Condition condition_of(const SystemStatus& system) {
  Condition condition{severity_of(system.state), std::string(operator_text(system.state))};
  if (system.recipe_refused) {
    if (condition.severity == Severity::None) condition.severity = Severity::Warning;
    condition.text += "; a camera refused the recipe's settings";
  }
  if (system.configuration_refused) {
    if (condition.severity == Severity::None) condition.severity = Severity::Warning;
    condition.text += "; the configuration is invalid, the last good one runs: see the log";
  }
  if (system.line_faults != 0 || system.interface_faults != 0) {
    if (condition.severity == Severity::None) condition.severity = Severity::Warning;
    if (system.line_faults != 0) condition.text += "; a line has a fault: see line_faults";
    if (system.interface_faults != 0) {
      condition.text += "; an interface cannot be opened: see interface_faults";
    }
  }
  return condition;
}

Condition condition_of(const CameraStatus& camera) {
  if (camera.fault == hal::Fault::None && camera.last_frame == hal::TimePoint{}) {
    return {Severity::Unknown, "no frame yet"};
  }
  Condition condition{camera.fault == hal::Fault::None ? Severity::None : Severity::Alarm,
                      std::string(operator_text(camera.fault))};
  const auto add = [&](const char* what, auto level) {
    condition.severity = std::max(condition.severity, severity_of(level));
    if (severity_of(level) > Severity::None) {
      condition.text += std::string("; ") + what + " is " + std::string(operator_text(level));
    }
  };
  const bool is_registered = camera.alignment != AlignmentLevel::NotRegistered;
  add(is_registered ? "its alignment" : "it", camera.alignment);
  add("its outline", camera.outline_check);
  add("its focus", camera.focus);
  add("its ball's dirt", camera.cleanliness);
  return condition;
}

Condition condition_of(const ViewStatus& view) {
  if (view.published == 0) return {Severity::Unknown, "no picture yet"};
  return {Severity::None, "published"};
}

Condition condition_of(const RegionStatus& region) {
  const bool measured = region.quality != Quality::NotMeasured;
  return {measured ? Severity::None : Severity::Unknown,
          std::string(operator_text(region.quality))};
}

Condition condition_of(const AlarmStatus& alarm) {
  Severity severity = standing_severity(alarm);
  if (severity == Severity::None && signals::awaits_acknowledgement(alarm.alarm.state)) {
    severity = Severity::Warning;
  }
  return {severity, std::string(operator_text(alarm.alarm.state))};
}

Condition condition_of(const Health& health) {
  const bool known = std::ranges::any_of(
      kHealthFigures, [&](const auto& info) { return signals::is_valid(health.*info.get); });
  if (!known) return {Severity::Unknown, "not known yet"};
  std::string text;
  const auto add = [&text](bool is_so, const char* complaint) {
    if (is_so) text += std::string(text.empty() ? "" : "; ") + complaint;
  };
  add(has_under_voltage(health), "under-voltage: the supply or its cable is too weak");
  add(is_slowed_down(health), "the processors are throttled: too hot, or the supply is too weak");
  add(health.clock_synchronised == 0, "the clock follows no time server");
  add(health.commands_recorded == 0, "commands are not recorded: see state_folder");
  if (text.empty()) return {Severity::None, "no complaint"};
  return {Severity::Warning, text};
}

/// A stage has figures only; their sum is judged as the system's load.
Condition condition_of(const StageStatus& /*stage*/) { return {Severity::None, "measured"}; }

Condition condition_of(const MachineStatus& machine) {
  return {is_fault(machine.quality) ? Severity::Alarm : Severity::None,
          std::string(operator_text(machine.quality))};
}

Severity standing_severity(const AlarmStatus& alarm) {
  if (!signals::is_active(alarm.alarm.state)) return Severity::None;
  return std::max(severity_of(alarm.alarm.level), severity_of(alarm.alarm.announced));
}

Severity worst_severity(const Status& status, std::optional<std::size_t> region) {
  Severity worst = Severity::None;
  for (std::size_t i = 0; i < status.alarm_count; ++i) {
    const AlarmStatus& alarm = status.alarms[i];
    if (!region || alarm.region == *region) worst = std::max(worst, standing_severity(alarm));
  }
  return worst;
}

bool is_throttled(const Health& health) { return causes_now(health) != 0; }

bool has_under_voltage(const Health& health) { return (causes_now(health) & kUnderVoltage) != 0; }

}  // namespace orbwatch::app
