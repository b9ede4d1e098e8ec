// SPDX-License-Identifier: Apache-2.0
#include "app/ports/dds/status/event_message.h"

#include "app/model/status/condition.h"

namespace orbwatch::app::dds {
namespace {

constexpr char kAlarmKind[] = "alarm";

}  // namespace

const EventMessage& EventComposer::compose(const AlarmNotice& notice, const StatusNames& names,
                                           const TimeMessage& stamp) {
  source_ = alarm_name(notice, names);
  text_ = event_text(notice, names);
  figures_.clear();
  for (const Reading& reading : notice_readings(notice, names)) {
    figures_.push_back(figure_message(reading));
  }
  // The C API takes non-const pointers, but a write changes nothing.
  message_.header = {stamp, const_cast<char*>("")};
  message_.number = notice.number;
  message_.kind = const_cast<char*>(kAlarmKind);
  message_.source = source_.data();
  message_.severity = static_cast<std::uint8_t>(standing_severity(alarm_after(notice)));
  message_.text = text_.data();
  const auto count = static_cast<std::uint32_t>(figures_.size());
  message_.figures = {count, count, figures_.data(), false};
  return message_;
}

}  // namespace orbwatch::app::dds
