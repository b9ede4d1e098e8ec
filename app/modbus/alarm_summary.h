#pragma once

#include <algorithm>
#include <cstddef>
#include <optional>

#include "app/pipeline/status.h"

namespace orbwatch::app::modbus {

/// How bad an alarm is that stands: 1 a warning, 2 an alarm; 0 when it does not stand. A latched
/// one counts by what was announced.
inline int standing_severity(const AlarmStatus& alarm) {
  if (!signals::is_active(alarm.alarm.state)) return 0;
  return std::max(signals::severity(alarm.alarm.level), signals::severity(alarm.alarm.announced));
}

/// The worst that stands, in one region or in all.
inline int worst_severity(const Status& status, std::optional<std::size_t> region = std::nullopt) {
  int worst = 0;
  for (std::size_t i = 0; i < status.alarm_count; ++i) {
    const AlarmStatus& alarm = status.alarms[i];
    if (!region || alarm.region == *region) worst = std::max(worst, standing_severity(alarm));
  }
  return worst;
}

}  // namespace orbwatch::app::modbus
