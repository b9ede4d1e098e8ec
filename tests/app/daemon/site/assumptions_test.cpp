// SPDX-License-Identifier: Apache-2.0
#include "app/daemon/site/assumptions.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/app/daemon/demo_site.h"

namespace orbwatch::app::daemon {
namespace {

std::vector<std::string> assumed(const files::Resolved& site) {
  const auto plan = SitePlan::make(site, expected_formats(site));
  EXPECT_TRUE(plan) << plan.error().message;
  return plan ? assumptions(site, *plan) : std::vector<std::string>();
}

TEST(Assumptions, LimitsOfHotSpotsAreAssumedWhereTheRecipeStatesNone) {
  files::Resolved site = demo();
  pipeline::RegionOfInterest& region = site.recipes.front().regions.front();
  region.hot_spot_min_area.reset();
  region.hot_spot_max_speed.reset();
  auto said = assumed(site);
  ASSERT_FALSE(said.empty());
  EXPECT_THAT(said.front(),
              testing::HasSubstr("region " + region.name + ": assumes hot_spot_min_area = "));
  EXPECT_THAT(said.front(), testing::HasSubstr("hot_spot_max_speed = 200.0 mm/s"));
  const std::size_t all = said.size();
  region.hot_spot_min_area = 60;
  said = assumed(site);
  EXPECT_THAT(said.front(), testing::HasSubstr("assumes hot_spot_max_speed"));
  region.hot_spot_max_speed = 1000;
  EXPECT_EQ(assumed(site).size(), all - 1) << "all is stated";
  site.rig.scene = {};
  region.hot_spot_min_area.reset();
  region.hot_spot_max_speed.reset();
  for (pipeline::RegionOfInterest& any : site.recipes.front().regions) any.alarms.clear();
  EXPECT_TRUE(assumed(site).empty()) << "no surface is known";
}

TEST(Assumptions, ACameraThatIsNotRegisteredIsNamed) {
  files::Resolved site = demo();
  site.rig.cameras[site.rig_cameras[0]].is_registered = false;
  EXPECT_THAT(assumed(site).front(),
              testing::HasSubstr("camera " + site.names.cameras[0] + ": is not registered"));
}

}  // namespace
}  // namespace orbwatch::app::daemon
