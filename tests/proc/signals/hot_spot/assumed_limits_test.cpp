// SPDX-License-Identifier: Apache-2.0
#include "proc/signals/hot_spot/assumed_limits.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>

namespace orbwatch::signals {
namespace {

using optics::Vec3;

/// A ball in the middle of a room with walls 500 mm away.
RegionScene room() {
  const optics::Ball ball{{0, 0, 0}, 50};
  optics::Scene scene;
  scene.room = optics::Scene::Room::Box;
  scene.walls = {{-500, -500, -500}, {500, 500, 500}};
  return {ball, optics::SceneProxy::make(scene, ball).value()};
}

/// A view of the middle of a wall, 90 degrees wide.
optics::ViewProjection view(int width) {
  return optics::ViewProjection::make(
             {optics::ViewKind::Perspective, {0, 0, 0}, 90, {}, width, width})
      .value();
}

TEST(AssumedLimits, AreTheFootprintOfAPixelAndASpeedBelowThatOfSparks) {
  const auto limits = assumed_limits(view(200), room(), {}, 25);
  const double pixel = 2.0 * 500 / 200;  // mm on the wall, which its corners show at a slant
  const double turned = pixel * pixel / std::sqrt(3.0);
  EXPECT_NEAR(limits.min_area, turned, 0.03 * turned);
  EXPECT_EQ(limits.max_speed, kAssumedSpeed);
}

TEST(AssumedLimits, FollowTheViewsResolutionAndTheFrameRate) {
  const auto coarse = assumed_limits(view(100), room(), {}, 100);
  const auto fine = assumed_limits(view(400), room(), {}, 100);
  EXPECT_NEAR(coarse.min_area / fine.min_area, 16, 1);
  EXPECT_NEAR(coarse.max_speed, 100 * std::sqrt(coarse.min_area), 1e-9) << "a pixel per frame";
  EXPECT_NEAR(fine.max_speed, std::max(kAssumedSpeed, 100 * std::sqrt(fine.min_area)), 1e-9);
  EXPECT_EQ(assumed_limits(view(100), room(), {}, 0).max_speed, kAssumedSpeed) << "no rate known";
}

TEST(AssumedLimits, NeedASurfaceAndAnOutlineInTheView) {
  const optics::Ball ball{{0, 0, 0}, 50};
  EXPECT_FALSE(assumed_limits(view(100), {ball, {}}, {}, 25).need_surface());
  const std::array<Vec3, 3> behind{Vec3{0, -1, 0}, Vec3{0.1, -1, 0}, Vec3{0, -1, 0.1}};
  EXPECT_FALSE(assumed_limits(view(100), room(), behind, 25).need_surface());
}

}  // namespace
}  // namespace orbwatch::signals
