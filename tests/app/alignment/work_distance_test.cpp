// SPDX-License-Identifier: Apache-2.0
#include "app/alignment/work_distance.h"

#include <gtest/gtest.h>

#include <array>
#include <cmath>

namespace orbwatch::app {
namespace {

using optics::ViewSpec;

class WorkDistance : public testing::Test {
 protected:
  WorkDistance() {
    rig.ball = {{0, 0, 500}, 50};
    rig.scene.room = optics::Scene::Room::Box;
    rig.scene.walls = {{-1000, -1000, 0}, {1000, 1000, 900}};
    rig.scene.obstacles.push_back({{-100, -100, 10}, {100, 100, 100}});
    ahead.width = 640;
    ahead.height = 480;
  }

  optics::Rig rig;
  ViewSpec ahead;
};

TEST_F(WorkDistance, EndsAtTheStatedSceneInTheMiddleOfTheView) {
  ViewSpec down = ahead;
  down.orientation.pitch = -90;
  const auto of = [&](const ViewSpec& view) { return work_distance(rig, std::array{view}); };
  EXPECT_NEAR(of(down), 400, 1e-6) << "the obstacle's top";
  EXPECT_NEAR(of(ahead), 1000, 1e-6) << "a wall";
  const std::array both{down, ahead};
  EXPECT_NEAR(work_distance(rig, both), 1000, 1e-6) << "the farthest";
}

TEST_F(WorkDistance, IsUnknownWithoutASceneOrAView) {
  EXPECT_TRUE(std::isnan(work_distance(rig, {})));
  rig.scene = {};
  EXPECT_TRUE(std::isnan(work_distance(rig, std::array{ahead})));
}

}  // namespace
}  // namespace orbwatch::app
