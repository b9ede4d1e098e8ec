// SPDX-License-Identifier: Apache-2.0
#include "app/ports/web/interfaces/interface_routes.h"

#include <gmock/gmock.h>

#include <limits>
#include <nlohmann/json.hpp>

#include "tests/app/ports/web/served.h"

namespace orbwatch::app::web::tests {
namespace {

using nlohmann::json;

using Interfaces = Served;

TEST_F(Interfaces, AreShownAsTheyAreNow) {
  double requests = 1;
  tables = [&requests] {
    const double none = std::numeric_limits<double>::quiet_NaN();
    return std::vector<InterfaceTable>{
        {"modbus", "registers", {"name", "value"}, {{"state", 1.0}, {"peak \xFF", none}}},
        {"modbus", "clients", {"address", "may_write", "requests"}, {{"10.0.0.7", true, requests}}},
        {"dds", "topics", {"topic", "readers"}, {}}};
  };
  start();
  const auto shown = [this] { return json::parse(get(port(), "/api/v1/interfaces").body); };
  const json all = shown();
  EXPECT_EQ(all["modbus"]["registers"][0], (json{{"name", "state"}, {"value", 1.0}}));
  EXPECT_EQ(all["modbus"]["registers"][1]["name"], "peak \xEF\xBF\xBD");
  EXPECT_TRUE(all["modbus"]["registers"][1]["value"].is_null());
  EXPECT_EQ(all["modbus"]["clients"][0],
            (json{{"address", "10.0.0.7"}, {"may_write", true}, {"requests", 1.0}}));
  EXPECT_EQ(all["dds"]["topics"], json::array());
  requests = 2;
  EXPECT_EQ(shown()["modbus"]["clients"][0]["requests"], 2.0);
}

TEST_F(Interfaces, OfNoneAreNotServed) {
  start();
  EXPECT_EQ(get(port(), "/api/v1/interfaces").status, 404);
}

TEST_F(Interfaces, VersionsAndCommandersAreNamed) {
  program.versions = {{"orbwatchd", "1.2.3"}, {"libgpiod", "1.6.3"}};
  program.commanders = "takes commands from nobody";
  start();
  const json about = json::parse(get(port(), "/api/v1/about").body);
  EXPECT_EQ(about["versions"], (json{{"orbwatchd", "1.2.3"}, {"libgpiod", "1.6.3"}}));
  EXPECT_EQ(about["commanders"], program.commanders);
}

}  // namespace
}  // namespace orbwatch::app::web::tests
