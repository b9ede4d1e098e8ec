// SPDX-License-Identifier: Apache-2.0
#include "app/ports/web/history/history_records.h"

#include <algorithm>
#include <array>
#include <charconv>
#include <chrono>
#include <cmath>

#include "app/model/status/utc_text.h"

namespace orbwatch::app::web {
namespace {

/// Omits digits beyond the precision of `value`.
double shortened(float value) {
  if (!std::isfinite(value)) return signals::kNotValid;
  std::array<char, 32> text{};
  const auto* end = std::to_chars(text.data(), text.data() + text.size(), value).ptr;
  double same = 0;
  std::from_chars(text.data(), end, same);
  return same;
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

/// Limit of the alarm's level; nullopt for an unknown recipe.
std::optional<double> limit_of(const AlarmNotice& notice, std::span<const MeasuredRecipe> recipes) {
  const auto recipe = std::ranges::find(recipes, notice.recipe, &MeasuredRecipe::number);
  if (recipe == recipes.end() || notice.event.alarm >= recipe->alarms.size()) return std::nullopt;
  return reached_limit(recipe->alarms[notice.event.alarm], notice.event.level);
}

std::optional<std::string> unless_empty(std::string_view text) {
  return text.empty() ? std::nullopt : std::optional<std::string>(text);
}

}  // namespace

FigureAnswer figure_answer(const FigureHistory::Series& series, hal::TimePoint now) {
  using Seconds = std::chrono::duration<double>;
  FigureAnswer answer{
      series.unit, Seconds(FigureHistory::kStep).count(), age_s(series.end, now), {}, {}};
  for (const Extremes& step : series.steps) {
    answer.low.push_back(shortened(step.low));
    answer.high.push_back(shortened(step.high));
  }
  return answer;
}

SentAlarmEvent sent_event(const AlarmHistory::Entry& entry, const StatusNames& names,
                          std::span<const MeasuredRecipe> recipes) {
  const AlarmNotice& notice = entry.notice;
  return {notice,
          utc_text(entry.time).value_or(""),
          alarm_name(notice, names),
          notice.event.alarm + 1,
          unless_empty(names.region(notice.recipe, notice.region)),
          quantity_of(alarm_after(notice)).unit,
          limit_of(notice, recipes),
          unless_empty(notice.by.name()),
          unless_empty(notice.part.text())};
}

}  // namespace orbwatch::app::web
