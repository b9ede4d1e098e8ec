// SPDX-License-Identifier: Apache-2.0
#include "app/ports/web/fleet/fleet_routes.h"

#include <gmock/gmock.h>

#include <nlohmann/json.hpp>

#include "tests/app/ports/web/served.h"
#include "tests/support/temporary_folder.h"

namespace orbwatch::app::web::tests {
namespace {

using nlohmann::json;

class FleetRoutes : public Served {
 protected:
  void receive(const std::string& id, const std::string& name, hal::TimePoint now) const {
    ApplianceNotice notice;
    notice.name = name;
    notice.page = {"10.0.0.7", 8443};
    fleet->receive(id, notice, now);
  }
  json list() const { return json::parse(get(port(), "/api/v1/appliances").body); }
};

TEST_F(FleetRoutes, ListAppliancesAndMarkThoseThatAreGone) {
  fleet = std::make_shared<Fleet>();
  start();
  receive("02", "cell 2", hal::Clock::now());
  receive("01", "cell 1", hal::Clock::now() - std::chrono::minutes(1));
  const json all = list();
  EXPECT_TRUE(all["missing"].is_null());
  ASSERT_EQ(all["appliances"].size(), 2U);
  EXPECT_EQ(all["appliances"][0]["name"], "cell 1");
  EXPECT_EQ(all["appliances"][0]["is_gone"], true);
  EXPECT_EQ(all["appliances"][1]["is_gone"], false);
  EXPECT_EQ(all["appliances"][1]["page"], "https://10.0.0.7:8443/");
  EXPECT_TRUE(fleet->has_viewers(hal::Clock::now())) << "pictures are fetched from now on";
  EXPECT_EQ(fleet->forget_gone(hal::Clock::now()), 1U);
  EXPECT_EQ(list()["appliances"].size(), 1U);
}

TEST_F(FleetRoutes, ShowThePictureOfOneThatIsListed) {
  fleet = std::make_shared<Fleet>();
  start();
  receive("01", "cell 1", hal::Clock::now());
  EXPECT_EQ(get(port(), "/api/v1/appliances/picture.jpg?appliance=01").status, 404);
  fleet->show("01", "a picture");
  const Answer picture = get(port(), "/api/v1/appliances/picture.jpg?appliance=01");
  EXPECT_EQ(picture.status, 200);
  EXPECT_EQ(picture.body, "a picture");
  EXPECT_EQ(get(port(), "/api/v1/appliances/picture.jpg?appliance=02").status, 404);
  EXPECT_EQ(get(port(), "/api/v1/appliances/picture.jpg").status, 400);
}

TEST_F(FleetRoutes, RemoveThoseThatAreGoneAndRecordIt) {
  const orbwatch::tests::TemporaryFolder folder;
  state_folder = folder.path();
  fleet = std::make_shared<Fleet>();
  start();
  receive("01", "cell 1", hal::Clock::now() - std::chrono::minutes(1));
  receive("02", "cell 2", hal::Clock::now());
  list();
  const Answer answer = request(port(), "POST", "/api/v1/forget_appliances", kJsonHeader, "{}");
  EXPECT_EQ(json::parse(answer.body), (json{{"forgotten", 1}}));
  EXPECT_EQ(list()["appliances"].size(), 1U);
  const json audit = json::parse(get(port(), "/api/v1/audit").body);
  ASSERT_EQ(audit["entries"].size(), 1U);
  EXPECT_EQ(audit["entries"][0]["what"], "forget_appliances");
  EXPECT_EQ(audit["entries"][0]["after"], "1 removed");
}

TEST_F(FleetRoutes, SayWhichKeyIsMissingWithoutDds) {
  start();
  const json all = list();
  EXPECT_EQ(all["appliances"], json::array());
  EXPECT_THAT(all["missing"].get<std::string>(), testing::HasSubstr("enabled = true in [dds]"));
}

}  // namespace
}  // namespace orbwatch::app::web::tests
