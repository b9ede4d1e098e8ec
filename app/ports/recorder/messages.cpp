// SPDX-License-Identifier: Apache-2.0
#include "app/ports/recorder/messages.h"

#include <algorithm>
#include <array>
#include <span>
#include <utility>

#include "app/model/status/condition.h"

namespace orbwatch::app::recorder {
namespace {

constexpr std::array<std::string_view, 4> kRecordedKinds{"system", "region", "alarm", "machine"};

Header header_of(Utc stamp) {
  const auto second = std::chrono::floor<std::chrono::seconds>(stamp);
  const auto rest = std::chrono::duration_cast<std::chrono::nanoseconds>(stamp - second).count();
  return {static_cast<std::int32_t>(second.time_since_epoch().count()),
          static_cast<std::uint32_t>(rest),
          {}};
}

std::vector<Figure> figures_of(std::span<const Reading> readings) {
  std::vector<Figure> figures;
  for (const Reading& reading : readings) {
    figures.push_back({std::string(reading.name), reading.value, std::string(reading.unit),
                       std::string(reading.text)});
  }
  return figures;
}

}  // namespace

ProcessState process_state_of(const StatusReport& report) {
  const Status& status = report.status;
  ProcessState state{header_of(report.stamp),
                     status.frame_set,
                     status.trigger,
                     status.result,
                     status.recipe,
                     status.configuration_checksum,
                     static_cast<std::uint8_t>(status.state),
                     status.heartbeat,
                     {}};
  for (auto& [component, readings] : status_readings(report)) {
    if (std::ranges::find(kRecordedKinds, component.kind) == kRecordedKinds.end()) continue;
    state.components.push_back(
        {std::string(component.kind), std::move(component.name), figures_of(readings)});
  }
  return state;
}

EventMessage event_of(const AlarmNotice& notice, const StatusNames& names, Utc stamp) {
  EventMessage event;
  event.header = header_of(stamp);
  event.number = notice.number;
  event.source = alarm_name(notice, names);
  event.severity = static_cast<std::uint8_t>(standing_severity(alarm_after(notice)));
  event.text = event_text(notice, names);
  event.figures = figures_of(notice_readings(notice, names));
  return event;
}

}  // namespace orbwatch::app::recorder
