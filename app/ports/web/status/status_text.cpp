// SPDX-License-Identifier: Apache-2.0
#include "app/ports/web/status/status_text.h"

#include <nlohmann/json.hpp>

#include "app/model/json.h"
#include "app/model/readings.h"
#include "app/model/utc_text.h"

namespace orbwatch::app::web {
std::string status_json(const StatusReport& report, const WebStatistics& web, double age) {
  auto components = status_readings(report);
  components.push_back(component_readings(kWebComponent, web, report.now));
  nlohmann::ordered_json all = nlohmann::ordered_json::object();
  const auto stamp = utc_text(report.stamp);
  all["stamp"] = stamp ? nlohmann::ordered_json(*stamp) : nlohmann::ordered_json();
  all["age"] = to_json(age);
  all.update(to_json(components));
  return all.dump();
}

}  // namespace orbwatch::app::web
