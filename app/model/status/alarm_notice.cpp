// SPDX-License-Identifier: Apache-2.0
#include "app/model/status/alarm_notice.h"

#include <array>
#include <cstdio>

namespace orbwatch::app {
namespace {

std::string region_of(const AlarmNotice& notice, const StatusNames& names) {
  return name_or_number(names.region(notice.recipe, notice.region), notice.region);
}

template <class Enum>
Reading code(std::string_view name, Enum number) {
  return {name, static_cast<double>(number), {}, operator_text(number)};
}

}  // namespace

AlarmStatus alarm_after(const AlarmNotice& notice) {
  const signals::AlarmEvent& event = notice.event;
  AlarmStatus alarm;
  alarm.alarm = {event.state, event.level, event.level, !signals::is_valid(event.value)};
  alarm.region = static_cast<std::uint16_t>(notice.region);
  alarm.signal = notice.signal;
  alarm.value = event.value;
  return alarm;
}

std::string alarm_name(const AlarmNotice& notice, const StatusNames& names) {
  return alarm_name(notice.event.alarm, region_of(notice, names), notice.signal);
}

std::string event_text(const AlarmNotice& notice, const StatusNames& names) {
  std::string text = region_of(notice, names) + ": " + std::string(operator_text(notice.signal)) +
                     " " + std::string(operator_text(notice.event.kind)) + ", " +
                     std::string(operator_text(notice.event.level));
  if (!signals::is_valid(notice.event.value)) return text + ", not measured";
  std::array<char, 64> value{};
  std::snprintf(value.data(), value.size(), ", %.6g", notice.event.value);
  text += value.data();
  const std::string_view unit = quantity_of(alarm_after(notice)).unit;
  return unit.empty() ? text : text + " " + std::string(unit);
}

std::vector<Reading> notice_readings(const AlarmNotice& notice, const StatusNames& names) {
  return {
      {"alarm", static_cast<double>(notice.event.alarm + 1)},
      code("event", notice.event.kind),
      code("state", notice.event.state),
      code("level", notice.event.level),
      {"value", notice.event.value, quantity_of(alarm_after(notice)).unit},
      code("signal", notice.signal),
      {"region",
       static_cast<double>(notice.region),
       {},
       names.region(notice.recipe, notice.region)},
      {"recipe", static_cast<double>(notice.recipe)},
      {"frame_set", static_cast<double>(notice.frame_set)},
      {"part", signals::kNotValid, {}, notice.part.text()},
      {"layer", notice.layer},
  };
}

}  // namespace orbwatch::app
