#pragma once

#include <optional>
#include <string>

#include "app/model/status.h"

namespace orbwatch::app {

/// How bad it is. The numbers go to PLC and controller, as ROS' diagnostic levels too: append,
/// never renumber.
enum class Severity : std::uint8_t {
  None = 0,
  Warning = 1,
  Alarm = 2,
  Unknown = 3,  ///< nothing is known yet, or no more
};

/// The one place of the operator's text for each severity. Empty for a number that is none.
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

/// How bad a part of the appliance stands, and why, in one line for operators.
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

/// How bad an alarm stands: by the level that was announced or the present one, whichever is worse;
/// a latched alarm counts although its signal is within limits again. None unless it stands.
Severity standing_severity(const AlarmStatus& alarm);

/// The worst alarm that stands, in one region or in all.
Severity worst_severity(const Status& status, std::optional<std::size_t> region = std::nullopt);

/// The board is throttled now: it has under-voltage or is too hot.
bool is_throttled(const Health& health);

}  // namespace orbwatch::app
