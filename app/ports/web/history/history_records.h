// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "app/model/status/measured_recipe.h"
#include "app/ports/web/history/alarm_history.h"
#include "app/ports/web/history/figure_history.h"
#include "proc/settings/settings.h"

/// Records of histories. All reentrant.
namespace orbwatch::app::web {

struct FigureQuery {
  std::string figure, region, camera;
};
template <class Visitor>
void visit(Visitor& v, FigureQuery& query) {
  v.required("figure", query.figure, "Name of the figure");
  v.optional("region", query.region, "Name of the region; either region or camera is required");
  v.optional("camera", query.camera, "Name of the camera");
  v.require(query.region.empty() != query.camera.empty(),
            "either region=NAME or camera=NAME must be set");
}

struct FigureAnswer {
  std::string_view unit;
  double step = 0, age = 0;
  std::vector<double> low, high;
};
template <class Visitor>
void visit(Visitor& v, FigureAnswer& answer) {
  v.required("unit", answer.unit, "Unit of the figure");
  v.required("step", answer.step, "Duration of a step", "s");
  v.required("age", answer.age, "Time since the end of the newest step; null: there is none", "s");
  v.required("low", answer.low, "Lowest value of each step, oldest first; null: not measured");
  v.required("high", answer.high, "Highest value of each step");
}
FigureAnswer figure_answer(const FigureHistory::Series& series, hal::TimePoint now);

struct AlarmsQuery {
  std::size_t events = 100;
};
template <class Visitor>
void visit(Visitor& v, AlarmsQuery& query) {
  v.optional("events", query.events, Range::between(0, AlarmHistory::kMost), "Limit of events");
}

/// An event with the readings of app/model/status/alarm_notice.h.
struct SentAlarmEvent {
  AlarmNotice notice;
  std::string time, name;
  std::size_t alarm = 0;
  std::optional<std::string> region;
  std::string_view unit;
  std::optional<double> limit;
  std::optional<std::string> by;
  std::optional<std::string> part;
};
template <class Visitor>
void visit(Visitor& v, SentAlarmEvent& sent) {
  AlarmNotice& notice = sent.notice;
  v.required("number", notice.number, "Counts events, from 1, also over restarts");
  v.required("time", sent.time, "UTC, ISO 8601");
  v.required("name", sent.name, "Name of the alarm");
  v.required("alarm", sent.alarm, "Argument alarm of acknowledge_alarm");
  v.required("event", notice.event.kind, "Kind of the event");
  v.required("state", notice.event.state, "State of the alarm after it");
  v.required("level", notice.event.level, "Limit that was reached");
  v.required("value", notice.event.value, "Value of the signal; null: not measured");
  v.required("signal", notice.signal, "Signal of the alarm");
  v.required("region", notice.region, "Place of the region in the recipe, from 0");
  v.optional("region_text", sent.region, "Name of the region");
  v.required("recipe", notice.recipe, "Number of the recipe");
  v.required("frame_set", notice.frame_set, "Number of the newest frame set at that time");
  v.required("part", sent.part, "Part that the machine made; null: not known");
  v.required("layer", notice.layer, "Its layer; null: not known");
  v.required("unit", sent.unit, "Unit of value and limit");
  v.required("limit", sent.limit, "Limit of the level; null: none");
  v.required("by", sent.by, "User who acknowledged; null: none");
}
SentAlarmEvent sent_event(const AlarmHistory::Entry& entry, const StatusNames& names,
                          std::span<const MeasuredRecipe> recipes);

struct AlarmsAnswer {
  std::vector<SentAlarmEvent> alarms;
};
template <class Visitor>
void visit(Visitor& v, AlarmsAnswer& answer) {
  v.required("alarms", answer.alarms, "Newest events, oldest first");
}

}  // namespace orbwatch::app::web
