// SPDX-License-Identifier: Apache-2.0
#include "app/model/status/readings.h"

namespace orbwatch::app {

std::string name_or_number(std::string_view name, std::size_t index) {
  return name.empty() ? std::to_string(index + 1) : std::string(name);
}

std::string alarm_name(std::size_t index, std::string_view region, SignalNumber signal) {
  return std::to_string(index + 1) + ", " + std::string(region) + ": " +
         std::string(operator_text(signal));
}

std::vector<ComponentReadings> status_readings(const StatusReport& report) {
  std::vector<ComponentReadings> all;
  for_each_component(report, [&](Component component, const auto& part) {
    all.push_back(component_readings(std::move(component), part, report.now));
  });
  return all;
}

}  // namespace orbwatch::app
