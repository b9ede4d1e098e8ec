// SPDX-License-Identifier: Apache-2.0
#include "app/ports/dds/status/process_state.h"

#include <cstdint>

#include "app/ports/dds/participant/time_message.h"

namespace orbwatch::app::dds {
namespace {

/// Casts const away: the C API takes non-const pointers, but a write changes nothing.
char* text(std::string_view zero_terminated) {
  return const_cast<char*>(zero_terminated.empty() ? "" : zero_terminated.data());
}

}  // namespace

FigureMessage figure_message(const Reading& reading) {
  return {text(reading.name), reading.value, text(reading.unit), text(reading.text)};
}

const ProcessStateMessage& ProcessStateComposer::compose(const StatusReport& report,
                                                         const CommandCounts& commands) {
  parts_ = status_readings(report);
  parts_.push_back(component_readings({kCommandsKind}, commands, report.now));
  figures_.clear();
  for (const ComponentReadings& part : parts_) {
    for (const Reading& reading : part.readings) figures_.push_back(figure_message(reading));
  }
  components_.clear();
  FigureMessage* next = figures_.data();
  for (const auto& [component, readings] : parts_) {
    const auto count = static_cast<std::uint32_t>(readings.size());
    components_.push_back(
        {text(component.kind), text(component.name), {count, count, next, false}});
    next += count;
  }
  const Status& status = report.status;
  message_.header = {to_message(report.stamp), text("")};
  message_.frame_set = status.frame_set;
  message_.trigger = status.trigger;
  message_.result = status.result;
  message_.recipe = status.recipe;
  message_.configuration_checksum = status.configuration_checksum;
  message_.system_state = static_cast<std::uint8_t>(status.state);
  message_.heartbeat = status.heartbeat;
  const auto count = static_cast<std::uint32_t>(components_.size());
  message_.components = {count, count, components_.data(), false};
  return message_;
}

}  // namespace orbwatch::app::dds
