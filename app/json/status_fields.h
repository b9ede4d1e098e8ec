#pragma once

#include <algorithm>

#include "app/json/utc_text.h"
#include "app/pipeline/status_report.h"

/// The one declaration of what a status says, for JSON and for tables. A visitor offers
///   field(name, value): a text, a number, a truth, or nothing;
///   field(name, value, unit): a measured number, NaN: not valid;
///   code(name, number, text): a number of a closed list and what it means;
///   object(name, fill): members that fill(visitor) visits;
///   list(name, count, fill): entries that fill(visitor, index) visits.
namespace orbwatch::app {

/// The name of entry `index`, empty when it has none.
inline std::string_view name_at(const std::vector<std::string>& names, std::size_t index) {
  return index < names.size() ? std::string_view(names[index]) : std::string_view{};
}

template <class Visitor, class Values, class Infos>
void visit_values(Visitor& v, const Values& values, const Infos& infos) {
  for (const auto& info : infos) v.field(info.name, values.*info.member, info.unit);
}

template <class Visitor>
void visit(Visitor& v, const RegionStatus& region) {
  v.code("quality", static_cast<int>(region.quality), name_of(region.quality));
  v.object("signals",
           [&region](auto& signals) { visit_values(signals, region.signals, signals::kSignals); });
}

template <class Visitor>
void visit(Visitor& v, const AlarmStatus& alarm, double age_s) {
  v.field("signal", signals::kSignals[alarm.signal].name);
  v.code("state", static_cast<int>(alarm.alarm.state), operator_text(alarm.alarm.state));
  v.code("level", static_cast<int>(alarm.alarm.level), operator_text(alarm.alarm.level));
  v.code("announced", static_cast<int>(alarm.alarm.announced),
         operator_text(alarm.alarm.announced));
  v.field("measurement_lost", alarm.alarm.measurement_lost);
  v.field("value", alarm.value, signals::kSignals[alarm.signal].unit);
  v.field("age_s", age_s);
}

template <class Visitor>
void visit(Visitor& v, const CameraStatus& camera, double last_frame_age_s) {
  v.code("fault", static_cast<int>(camera.fault), operator_text(camera.fault));
  v.field("frames_per_second", camera.frames_per_second);
  v.field("latency_p50_ms", camera.latency_p50_ms);
  v.field("latency_p99_ms", camera.latency_p99_ms);
  v.field("last_frame_age_s", last_frame_age_s);
  v.field("frames", camera.frames);
  v.field("lost", camera.lost);
  v.field("dropped", camera.dropped);
  v.field("unmatched", camera.unmatched);
  v.field("triggers", camera.triggers);
  v.field("missed", camera.missed);
}

template <class Visitor>
void visit(Visitor& v, const ViewStatus& view) {
  v.field("frames_per_second", view.frames_per_second);
  v.field("latency_p50_ms", view.latency_p50_ms);
  v.field("latency_p99_ms", view.latency_p99_ms);
  v.field("published", view.published);
  v.field("skipped", view.skipped);
  v.field("superseded", view.superseded);
}

template <class Visitor>
void visit_lists(Visitor& v, const StatusReport& report) {
  const Status& s = report.status;
  v.list("regions", s.region_count, [&](auto& entry, std::size_t i) {
    entry.field("region", report.names.region(s.recipe, i));
    visit(entry, s.regions[i]);
  });
  v.list("alarms", s.alarm_count, [&](auto& entry, std::size_t i) {
    entry.field("alarm", i + 1);
    entry.field("region", report.names.region(s.recipe, s.alarms[i].region));
    visit(entry, s.alarms[i], report.times.alarm_age_s[i]);
  });
  v.list("cameras", s.camera_count, [&](auto& entry, std::size_t i) {
    entry.field("camera", name_at(report.names.cameras, i));
    visit(entry, s.cameras[i], report.times.last_frame_age_s[i]);
  });
  v.list("views", s.view_count, [&](auto& entry, std::size_t i) {
    entry.field("view", name_at(report.names.views, i));
    visit(entry, s.views[i]);
  });
}

template <class Visitor>
void visit(Visitor& v, const StatusReport& report) {
  const Status& s = report.status;
  v.field("stamp", utc_text(report.times.stamp));
  v.code("system_state", static_cast<int>(s.state), name_of(s.state));
  v.field("heartbeat", s.heartbeat);
  v.field("frame_set", s.frame_set);
  v.field("trigger", s.trigger);
  v.field("result", s.result);
  v.field("recipe", s.recipe);
  v.field("configuration_checksum", s.configuration_checksum);
  v.field("recipe_refused", s.recipe_refused);
  v.field("process_active", s.process_active);
  v.field("process_inputs", s.process_inputs);
  v.field("selected_view", s.selected_view);
  v.field("overruns", s.overruns);
  v.field("unmatched", s.unmatched);
  v.field("skew_ms", s.skew_ms);
  v.field("load", s.load);
  visit_lists(v, report);
  v.object("health", [&s](auto& health) { visit_values(health, s.health, kHealthFigures); });
}

}  // namespace orbwatch::app
