// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <concepts>
#include <cstddef>
#include <functional>
#include <string>
#include <string_view>
#include <type_traits>
#include <utility>
#include <vector>

#include "app/model/status/status_report.h"

/// A status as a flat list of components, each a list of named values: the form in which it leaves
/// the process as JSON, tables, diagnostics and DDS samples. All reentrant.
namespace orbwatch::app {

/// One value that explains itself.
struct Reading {
  std::string_view name;
  double value = signals::kNotValid;  ///< NaN: not valid
  std::string_view unit{};            ///< empty: a count, a code or a ratio
  std::string_view text{};            ///< meaning of a code; "true" or "false" for a flag; a text

  bool operator==(const Reading&) const = default;
};

/// True: a text without a number, such as a name; the text of a code has its number.
inline bool is_text(const Reading& reading) {
  return !reading.text.empty() && !signals::is_valid(reading.value);
}

inline Reading reading_of(const FieldInfo& field, double value, hal::TimePoint /*now*/) {
  return {field.name, value, field.unit, {}};
}
inline Reading reading_of(const FieldInfo& field, bool flag, hal::TimePoint /*now*/) {
  return {field.name, flag ? 1.0 : 0.0, {}, flag ? "true" : "false"};
}
inline Reading reading_of(const FieldInfo& field, hal::TimePoint moment, hal::TimePoint now) {
  return {field.name, age_s(moment, now), field.unit, {}};
}
template <std::unsigned_integral Count>
Reading reading_of(const FieldInfo& field, Count count, hal::TimePoint /*now*/) {
  return {field.name, static_cast<double>(count), field.unit, {}};
}
template <Enumeration Enum>
Reading reading_of(const FieldInfo& field, Enum code, hal::TimePoint /*now*/) {
  return {field.name, static_cast<double>(code), {}, operator_text(code)};
}

/// A text: no number, and empty where it is not known.
inline Reading reading_of(const FieldInfo& field, const PartName& part, hal::TimePoint /*now*/) {
  return {field.name, signals::kNotValid, {}, part.text()};
}

/// Calls `visit(Reading)` for every field of a part that describes itself by for_each_field(): the
/// parts of a Status, and the parts that interfaces add.
template <class Part, class Visit>
void for_each_reading(const Part& part, hal::TimePoint now, Visit&& visit) {
  for_each_field(std::type_identity<Part>{}, [&](const auto& field) {
    Reading reading = reading_of(field, std::invoke(field.get, part), now);
    if constexpr (std::is_same_v<Part, AlarmStatus>) {
      if (field.name == "value") reading.unit = quantity_of(part).unit;
    }
    visit(reading);
  });
}

/// Part of the appliance to which a list of readings belongs.
struct Component {
  std::string_view kind;  ///< "system", "region", "alarm", "camera", "view", "health", "machine",
                          ///< "stage"
  std::string name{};     ///< its number from 1 if it has no name; empty if it is the only one

  bool operator==(const Component&) const = default;
};

/// The name of part `index` of a list: its own one, or its number from 1.
std::string name_or_number(std::string_view name, std::size_t index);

/// Name of an alarm from its number (that of acknowledge_alarm), region and signal: "2, weld:
/// hot_spot_width". `region` is the name or number of its region, `index` its place in the recipe's
/// list of alarms.
std::string alarm_name(std::size_t index, std::string_view region, SignalNumber signal);

/// Calls `visit(Component, part)` for every part of a status, in this order. Counts beyond the
/// arrays are cut.
template <class Visit>
void for_each_component(const StatusReport& report, Visit&& visit) {
  const Status& s = report.status;
  visit(Component{"system"}, static_cast<const SystemStatus&>(s));
  for (std::size_t i = 0; i < std::min(s.region_count, s.regions.size()); ++i) {
    visit(Component{"region", name_or_number(report.names.region(s.recipe, i), i)}, s.regions[i]);
  }
  for (std::size_t i = 0; i < std::min(s.alarm_count, s.alarms.size()); ++i) {
    const AlarmStatus& alarm = s.alarms[i];
    const std::string region =
        name_or_number(report.names.region(s.recipe, alarm.region), alarm.region);
    visit(Component{"alarm", alarm_name(i, region, alarm.signal)}, alarm);
  }
  for (std::size_t i = 0; i < std::min(s.camera_count, s.cameras.size()); ++i) {
    visit(Component{"camera", name_or_number(report.names.camera(i), i)}, s.cameras[i]);
  }
  for (std::size_t i = 0; i < std::min(s.view_count, s.views.size()); ++i) {
    visit(Component{"view", name_or_number(report.names.view(i), i)}, s.views[i]);
  }
  visit(Component{"health"}, s.health);
  if (s.machine.quality != MachineQuality::NotConfigured) visit(Component{"machine"}, s.machine);
  for (std::size_t i = 0; i < s.stages.size(); ++i) {
    visit(Component{"stage", std::string(name_of(static_cast<Stage>(i)))}, s.stages[i]);
  }
}

/// A component with its readings. Their texts are views, of static lists or of the status unless
/// the producer states another owner.
struct ComponentReadings {
  Component component;
  std::vector<Reading> readings;

  bool operator==(const ComponentReadings&) const = default;
};

template <class Part>
ComponentReadings component_readings(Component component, const Part& part, hal::TimePoint now) {
  ComponentReadings all{std::move(component), {}};
  for_each_reading(part, now, [&all](const Reading& reading) { all.readings.push_back(reading); });
  return all;
}

/// All readings of a status, in the order of for_each_component().
std::vector<ComponentReadings> status_readings(const StatusReport& report);

}  // namespace orbwatch::app
