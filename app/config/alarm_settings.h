#pragma once

#include <cstddef>

#include "app/config/recipe.h"
#include "proc/image/result.h"
#include "proc/signals/alarm_limits.h"

namespace orbwatch::app {

/// The limits as the alarms take them, of a region by its place in the recipe. Error: there is no
/// such signal.
Result<signals::AlarmLimits> alarm_limits(const AlarmSettings& settings, std::size_t region);

}  // namespace orbwatch::app
