// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <string>

#include "app/model/status/status.h"

namespace orbwatch::app {

/// Severity of a condition. The numbers go to PLC and controller, as ROS' diagnostic levels too:
/// append, never renumber.
enum class Severity : std::uint8_t {
  None = 0,
  Warning = 1,
  Alarm = 2,
  Unknown = 3,  ///< not known yet, or no longer known
};

/// The one place of the operator's text for each severity. Empty for an unknown number.
constexpr std::string_view operator_text(Severity severity) {
  switch (severity) {
    case Severity::None:
      return "none";
    case Severity::Warning:
      return "warning";
    case Severity::Alarm:
      return "alarm";
    case Severity::Unknown:
      return "unknown";
  }
  return {};
}

/// Severity of a part's condition, with the reason in one line for operators.
struct Condition {
  Severity severity = Severity::None;
  std::string text;
};

/// The one place that judges each part. All reentrant.
Condition condition_of(const SystemStatus& system);
Condition condition_of(const CameraStatus& camera);
Condition condition_of(const ViewStatus& view);
Condition condition_of(const RegionStatus& region);
Condition condition_of(const AlarmStatus& alarm);
Condition condition_of(const Health& health);
Condition condition_of(const StageStatus& stage);
Condition condition_of(const MachineStatus& machine);

/// Severity of an active alarm: that of the announced or the present level, whichever is worse; a
/// latched alarm counts although its signal is within limits again. None: the alarm is not active.
Severity standing_severity(const AlarmStatus& alarm);

/// Severity of the worst active alarm, in one region or in all.
Severity worst_severity(const Status& status, std::optional<std::size_t> region = std::nullopt);

/// The board is throttled now: it has under-voltage or is too hot.
bool is_throttled(const Health& health);

/// The supply's voltage is too low now, or was within the last seconds.
bool has_under_voltage(const Health& health);

}  // namespace orbwatch::app
