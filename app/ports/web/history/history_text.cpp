// SPDX-License-Identifier: Apache-2.0
#include "app/ports/web/history/history_text.h"

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <nlohmann/json.hpp>

#include "app/model/json.h"
#include "app/model/utc_text.h"

namespace orbwatch::app::web {
namespace {

using Json = nlohmann::ordered_json;

/// Omits digits beyond the precision of `value`.
Json short_json(float value) {
  if (!std::isfinite(value)) return nullptr;
  std::array<char, 32> text{};
  const auto* end = std::to_chars(text.data(), text.data() + text.size(), value).ptr;
  double same = 0;
  std::from_chars(text.data(), end, same);
  return to_json(same);
}

Json steps_json(const std::vector<Extremes>& steps, float Extremes::*value) {
  Json list = Json::array();
  for (const Extremes& step : steps) list.push_back(short_json(step.*value));
  return list;
}

std::optional<double> reached_limit(const signals::AlarmLimits& limits, signals::AlarmLevel level) {
  switch (level) {
    case signals::AlarmLevel::LowAlarm:
      return limits.low_alarm;
    case signals::AlarmLevel::LowWarning:
      return limits.low_warning;
    case signals::AlarmLevel::HighWarning:
      return limits.high_warning;
    case signals::AlarmLevel::HighAlarm:
      return limits.high_alarm;
    case signals::AlarmLevel::None:
    case signals::AlarmLevel::NoMeasurement:
      break;
  }
  return std::nullopt;
}

/// Limit of the alarm's level; null for an unknown recipe.
Json limit_json(const AlarmNotice& notice, std::span<const MeasuredRecipe> recipes) {
  const auto recipe = std::ranges::find(recipes, notice.recipe, &MeasuredRecipe::number);
  if (recipe == recipes.end() || notice.event.alarm >= recipe->alarms.size()) return nullptr;
  const auto limit = reached_limit(recipe->alarms[notice.event.alarm], notice.event.level);
  return limit ? to_json(*limit) : Json();
}

Json event_json(const AlarmHistory::Entry& entry, const StatusNames& names,
                std::span<const MeasuredRecipe> recipes) {
  const AlarmNotice& notice = entry.notice;
  Json json{{"number", notice.number},
            {"time", utc_text(entry.time).value_or("")},
            {"name", alarm_name(notice, names)}};
  json.update(to_json(notice_readings(notice, names)));
  json["unit"] = quantity_of(alarm_after(notice)).unit;
  json["limit"] = limit_json(notice, recipes);
  const std::string_view by = notice.by.name();
  json["by"] = by.empty() ? Json() : Json(by);
  return json;
}

}  // namespace

std::string series_json(const FigureHistory::Series& series, hal::TimePoint now) {
  using Seconds = std::chrono::duration<double>;
  return Json{{"unit", series.unit},
              {"step", Seconds(FigureHistory::kStep).count()},
              {"age", to_json(age_s(series.end, now))},
              {"low", steps_json(series.steps, &Extremes::low)},
              {"high", steps_json(series.steps, &Extremes::high)}}
      .dump();
}

std::string alarm_events_json(std::span<const AlarmHistory::Entry> entries,
                              const StatusNames& names, std::span<const MeasuredRecipe> recipes) {
  Json events = Json::array();
  for (const auto& entry : entries) events.push_back(event_json(entry, names, recipes));
  return Json{{"alarms", std::move(events)}}.dump();
}

}  // namespace orbwatch::app::web
