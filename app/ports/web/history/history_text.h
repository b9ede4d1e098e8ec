// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <span>
#include <string>

#include "app/model/measured_recipe.h"
#include "app/ports/web/history/alarm_history.h"
#include "app/ports/web/history/figure_history.h"

/// Histories as JSON. All reentrant.
namespace orbwatch::app::web {

/// {"unit", "step": s, "age": s since the end of the newest step or null, "low": [...], "high":
/// [...]}, oldest first; null: not measured in that step.
std::string series_json(const FigureHistory::Series& series, hal::TimePoint now);

/// {"alarms": [...]}: for each event its number, time (UTC), the alarm's name, the readings of
/// app/model/alarm_notice.h, the limit of its level and the user who acknowledged it; null where
/// there is none.
std::string alarm_events_json(std::span<const AlarmHistory::Entry> entries,
                              const StatusNames& names, std::span<const MeasuredRecipe> recipes);

}  // namespace orbwatch::app::web
