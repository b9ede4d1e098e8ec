// SPDX-License-Identifier: Apache-2.0
#include <fstream>
#include <nlohmann/json.hpp>
#include <regex>
#include <set>

#include "app/ports/dds/status/dds_statistics.h"
#include "app/ports/modbus/map/process_image.h"
#include "tests/app/ports/web/served.h"

namespace orbwatch::app::web::tests {
namespace {

using nlohmann::json;

/// Queries of the shipped dashboard, with their panels.
std::vector<std::pair<std::string, std::string>> queries() {
  std::ifstream in(std::filesystem::path(ORBWATCH_SOURCE_DIR) / "platform/grafana/orbwatch.json");
  std::vector<std::pair<std::string, std::string>> all;
  const json dashboard = json::parse(in);
  for (const auto& panel : dashboard["panels"]) {
    const json targets = panel.value("targets", json::array());
    for (const auto& target : targets) {
      all.emplace_back(panel["title"], target["expr"]);
    }
  }
  return all;
}

/// Example counters of the interfaces.
std::vector<InterfaceMetric> interface_metrics() {
  std::vector<InterfaceMetric> all;
  add_metrics(all, {"modbus"}, modbus::ServerStatus{}, {});
  add_metrics(all, {"modbus_results"}, modbus::ResultQueueStatus{}, {});
  add_metrics(all, {"modbus_plc"}, modbus::PlcStatus{}, {});
  add_metrics(all, {"dds"}, dds::DdsCounts{}, {});
  add_metrics(all, {"dds_topic", "rt/orbwatch/event"}, dds::TopicStatistics{}, {});
  return all;
}

using Dashboard = Served;

TEST_F(Dashboard, AsksForMetricsThatThereAre) {
  metrics = interface_metrics;
  start();
  const std::string text = get(port(), "/metrics").body;
  static const std::regex kSample(R"rx((^|\n)(orbwatch_\w+)(\{| ))rx"),
      kName(R"rx(orbwatch_\w+)rx");
  std::set<std::string> served;
  for (std::sregex_iterator it(text.begin(), text.end(), kSample), end; it != end; ++it) {
    served.insert((*it)[2]);
  }
  std::set<std::string> kinds;
  for (const auto& [panel, query] : queries()) {
    std::smatch name;
    ASSERT_TRUE(std::regex_search(query, name, kName)) << panel << " asks for nothing: " << query;
    EXPECT_TRUE(served.contains(name.str())) << panel << " asks for " << name.str();
    kinds.insert(name.str().substr(0, name.str().find('_', sizeof("orbwatch_"))));
  }
  EXPECT_EQ(kinds, (std::set<std::string>{"orbwatch_alarm", "orbwatch_camera", "orbwatch_dds",
                                          "orbwatch_health", "orbwatch_modbus", "orbwatch_region",
                                          "orbwatch_stage", "orbwatch_system", "orbwatch_view",
                                          "orbwatch_web"}));
}

}  // namespace
}  // namespace orbwatch::app::web::tests
