#include "app/dds/alarm_event.h"

#include <algorithm>
#include <array>
#include <cstdio>

namespace orbwatch::app {

namespace {

const signals::SignalInfo& signal_of(const AlarmNotice& notice) {
  return signals::kSignals[std::min(notice.signal, signals::kSignals.size() - 1)];
}

}  // namespace

std::string notice_text(const AlarmNotice& notice, const StatusNames& names) {
  const std::string_view region = names.region(notice.recipe, notice.region);
  const signals::SignalInfo& signal = signal_of(notice);
  std::string text =
      (region.empty() ? "region " + std::to_string(notice.region + 1) : std::string(region)) +
      ": " + std::string(signal.name) + " " + std::string(operator_text(notice.event.kind)) + ", " +
      std::string(operator_text(notice.event.level));
  if (!signals::is_valid(notice.event.value)) return text + ", not measured";
  std::array<char, 64> value{};
  std::snprintf(value.data(), value.size(), ", %.6g", notice.event.value);
  text += value.data();
  return signal.unit.empty() ? text : text + " " + std::string(signal.unit);
}

AlarmEventMessage event_message(const AlarmNotice& notice, const TimeMessage& stamp,
                                std::string& text) {
  AlarmEventMessage message{};
  message.stamp = stamp;
  message.number = notice.number;
  message.frame_set = notice.frame_set;
  message.recipe = notice.recipe;
  message.alarm = static_cast<std::uint32_t>(notice.event.alarm + 1);
  message.region = static_cast<std::uint32_t>(notice.region);
  // The C API takes no const pointers, but a write changes nothing.
  message.signal = const_cast<char*>(signal_of(notice).name.data());
  message.kind = static_cast<std::uint8_t>(notice.event.kind);
  message.state = static_cast<std::uint8_t>(notice.event.state);
  message.level = static_cast<std::uint8_t>(notice.event.level);
  message.value = notice.event.value;
  message.text = text.data();
  return message;
}

}  // namespace orbwatch::app
