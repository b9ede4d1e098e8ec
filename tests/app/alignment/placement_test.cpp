// SPDX-License-Identifier: Apache-2.0
#include "app/alignment/placement.h"

#include <gtest/gtest.h>

#include <vector>

#include "tests/app/alignment/rig_with_pose.h"

namespace orbwatch::app {
namespace {

TEST(Placement, RequestsWhatTheRigAndTheSettingsState) {
  const optics::Rig rig = tests::rig_with_pose({100, -540, 440});
  const PlacePrecision precision{0.5, 2, 0.25};
  auto request = place_request(rig, precision, align::BallCentre::Knowledge::Measured, 3);
  EXPECT_EQ(request.centre.knowledge, align::BallCentre::Knowledge::Measured);
  EXPECT_EQ(request.centre.position.x, rig.ball.centre.x);
  EXPECT_EQ(request.centre.sigma, 3);
  EXPECT_EQ(request.ball_radius, rig.ball.radius);
  EXPECT_EQ(request.sigma_px, 0.5);
  EXPECT_EQ(request.sigma_mm, 2);

  const std::vector<KnownPoint> of_one{{{10, 20}, {1, 2, 3}}, {{30, 40}, {4, 5, 6}}};
  const std::vector<KnownPoint> of_other{{{50, 60}, {4, 5, 6}}};
  for (const auto* points : {&of_one, &of_other}) {
    const auto camera = unplaced_camera(rig.cameras.front(), false);
    ASSERT_TRUE(camera) << camera.error().message;
    ASSERT_TRUE(add_camera(request, *camera, *points, nullptr, {}));
  }
  ASSERT_EQ(request.points.size(), 2U) << "the same coordinates are the same point";
  ASSERT_EQ(request.cameras.size(), 2U);
  ASSERT_EQ(request.cameras[0].marks.size(), 2U);
  ASSERT_EQ(request.cameras[1].marks.size(), 1U);
  EXPECT_EQ(request.cameras[0].marks[1].point, request.cameras[1].marks[0].point);
  EXPECT_EQ(request.cameras[1].marks[0].pixel.v, 60);
}

TEST(Placement, ShowsWhatBecameOfThePoints) {
  align::PlaceRequest request;
  request.points = {{1, 2, 3}, {4, 5, 6}};
  request.cameras.emplace_back().marks = {{1, {10, 20}}, {0, {30, 40}}};
  align::Placement placement;
  placement.cameras.emplace_back().marks = {{optics::Vec2{0.5, -0.5}, false}, {std::nullopt, true}};
  const auto points = placed_points(request, placement, 0);
  ASSERT_EQ(points.size(), 2U);
  EXPECT_EQ(points[0].point.x, 4);
  EXPECT_EQ(points[0].pixel.u, 10);
  ASSERT_TRUE(points[0].residual);
  EXPECT_EQ(points[0].residual->v, -0.5);
  EXPECT_FALSE(points[0].is_outlier);
  EXPECT_EQ(points[1].point.z, 3);
  EXPECT_FALSE(points[1].residual);
  EXPECT_TRUE(points[1].is_outlier);
}

}  // namespace
}  // namespace orbwatch::app
