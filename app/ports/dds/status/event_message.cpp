#include "app/ports/dds/status/event_message.h"

#include <array>
#include <cstdio>

#include "app/model/condition.h"

namespace orbwatch::app {
namespace {

constexpr char kAlarmKind[] = "alarm";

/// The alarm after the event, as far as the event says.
AlarmStatus alarm_after(const AlarmNotice& notice) {
  const signals::AlarmEvent& event = notice.event;
  AlarmStatus alarm;
  alarm.alarm = {event.state, event.level, event.level, !signals::is_valid(event.value)};
  alarm.region = static_cast<std::uint16_t>(notice.region);
  alarm.signal = notice.signal;
  alarm.value = event.value;
  return alarm;
}

std::string region_of(const AlarmNotice& notice, const StatusNames& names) {
  return name_or_number(names.region(notice.recipe, notice.region), notice.region);
}

template <class Enum>
Reading code(std::string_view name, Enum number) {
  return {name, static_cast<double>(number), {}, operator_text(number)};
}

}  // namespace

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

const EventMessage& EventComposer::compose(const AlarmNotice& notice, const StatusNames& names,
                                           const TimeMessage& stamp) {
  const AlarmStatus alarm = alarm_after(notice);
  source_ = alarm_name(notice.event.alarm, region_of(notice, names), notice.signal);
  text_ = event_text(notice, names);
  region_ = names.region(notice.recipe, notice.region);
  figures_.clear();
  for (const Reading& reading : std::initializer_list<Reading>{
           {"alarm", static_cast<double>(notice.event.alarm + 1)},
           code("event", notice.event.kind),
           code("state", notice.event.state),
           code("level", notice.event.level),
           {"value", notice.event.value, quantity_of(alarm).unit},
           code("signal", notice.signal),
           {"region", static_cast<double>(notice.region), {}, region_},
           {"recipe", static_cast<double>(notice.recipe)},
           {"frame_set", static_cast<double>(notice.frame_set)},
       }) {
    figures_.push_back(figure_message(reading));
  }
  // The C API takes no const pointers, but a write changes nothing.
  message_.header = {stamp, const_cast<char*>("")};
  message_.number = notice.number;
  message_.kind = const_cast<char*>(kAlarmKind);
  message_.source = source_.data();
  message_.severity = static_cast<std::uint8_t>(standing_severity(alarm));
  message_.text = text_.data();
  const auto count = static_cast<std::uint32_t>(figures_.size());
  message_.figures = {count, count, figures_.data(), false};
  return message_;
}

}  // namespace orbwatch::app
