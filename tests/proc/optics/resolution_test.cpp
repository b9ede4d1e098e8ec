// SPDX-License-Identifier: Apache-2.0
#include "proc/optics/resolution.h"

#include <gtest/gtest.h>

#include <random>

#include "proc/optics/vec.h"
#include "tests/proc/optics/random_camera.h"

namespace orbwatch::optics {
namespace {

BallProjection centred_ball(const BallModel& model, double radius) {
  return BallProjection::make(model, {{999.5, 999.5}, radius, radius, 0}, {}).value();
}

/// The direction at an angle from the one that faces the camera, radians.
Vec3 from_facing(double phi, double turn) {
  return {std::sin(phi) * std::cos(turn), std::cos(phi), std::sin(phi) * std::sin(turn)};
}

// The formula rho = sin(phi/2) gives R/2 cos(phi/2) px per radian along the radius; across it R
// sin(phi/2) / sin(phi) = R / (2 cos(phi/2)), which is more.
TEST(Resolution, IsTheDerivativeOfTheClassicalModel) {
  const auto ball = centred_ball(BallModel::make(BallModel::Kind::Classical).value(), 900);
  for (const double phi : {1e-9, 0.3, 1.0, 2.0, 3.0}) {
    for (const double turn : {0.0, 1.0, -2.0}) {
      const double truth = 900 * std::cos(phi / 2) / 2 * radians(1);
      EXPECT_NEAR(resolution(ball, from_facing(phi, turn)) / truth, 1, 1e-5) << phi;
    }
  }
}

// The axis has phi = 2i - psi with i = d psi, so that psi = phi / (2d - 1).
TEST(Resolution, OnTheAxisTheExactModelGivesPixelsPerPsi) {
  for (const double distance : {1.5, 4.0, 12.0}) {
    const auto model = BallModel::at_distance(BallModel::Kind::Exact, distance);
    const double limb = std::tan(std::asin(1 / distance));  // 900 px
    const double truth = 900 / limb / (2 * distance - 1) * radians(1);
    EXPECT_NEAR(resolution(centred_ball(model, 900), {0, 1, 0}) / truth, 1, 1e-6) << distance;
  }
}

TEST(Resolution, TakesTheWorseAxisOfAnEllipse) {
  const auto ball = BallProjection::make(BallModel::make(BallModel::Kind::Classical).value(),
                                         {{999.5, 999.5}, 900, 300, 40}, {})
                        .value();
  EXPECT_NEAR(resolution(ball, {0, 1, 0}), 300 / 2.0 * radians(1), 1e-4);
}

TEST(Resolution, FallsTowardsTheLimbAndIsNoneBehind) {
  const auto model = BallModel::make(BallModel::Kind::Exact, 340).value();
  const auto ball = centred_ball(model, 900);
  double last = resolution(ball, {0, 1, 0});
  for (double phi = 0.1; phi < radians(170); phi += 0.05) {
    const double here = resolution(ball, from_facing(phi, 0.4));
    EXPECT_LT(here, last);
    EXPECT_GT(here, 0);
    last = here;
  }
  // Right before the limb, where the blind cone is closer than the step of the difference.
  const double before = resolution(ball, from_facing(radians(170) - 2e-6, 0.4));
  EXPECT_GE(before, 0);
  EXPECT_LT(before, 0.01 * last);
  EXPECT_EQ(resolution(ball, from_facing(radians(170.001), 0.4)), 0);
}

TEST(Resolution, IsThatOfAThingAtTheScenesDistance) {
  std::mt19937 random(8);
  const auto camera = tests::random_camera(random, 6, 5);
  const auto ball = BallProjection::make(BallModel::Kind::Exact, camera, tests::kBall,
                                         tests::scene_around_ball(Scene::Room::Sphere, false))
                        .value();
  // The smaller singular value is the least shift of all directions of a small step.
  for (int i = 0; i < 50; ++i) {
    const Vec3 direction = tests::random_direction(random);
    const auto centre = ball.pixel(direction);
    if (!centre || angle_between(direction, ball.facing()) > radians(150)) continue;
    const double closeness = ball.proxy().hit(direction).closeness;
    const Vec3 first = normalized(cross(direction, tests::random_direction(random)));
    const Vec3 second = cross(direction, first);
    double least = 1e300;
    for (int k = 0; k < 1800; ++k) {
      const double turn = radians(k / 10.0);
      const auto aside = ball.pixel(
          normalized(direction + (first * std::cos(turn) + second * std::sin(turn)) * 1e-6),
          closeness);
      if (aside) least = std::min(least, std::hypot(aside->u - centre->u, aside->v - centre->v));
    }
    EXPECT_NEAR(resolution(ball, direction) / (least / 1e-6 * radians(1)), 1, 2e-3);
  }
}

TEST(Resolution, MapIsZeroWhereNothingIsSeen) {
  const auto ball = BallProjection::make(BallModel::make(BallModel::Kind::Exact, 300).value(),
                                         {{0, 50}, 40, 40, 0}, {})
                        .value();
  const auto view = ViewProjection::make({ViewKind::Equirectangular, {}, {}, {}, 72, 36}).value();
  const std::vector<float> map = resolution_map(view, ball, 100, 100);
  ASSERT_EQ(map.size(), 72U * 36);
  const auto at = [&](int lon) { return map[18 * 72 + 36 + lon / 5]; };
  EXPECT_NEAR(at(-90), resolution(ball, *view.direction(18, 18)), 1e-6);
  EXPECT_EQ(at(90), 0);   // left of the picture
  EXPECT_EQ(at(175), 0);  // blind
  const auto round = ViewProjection::make({ViewKind::Fisheye, {}, 360, {}, 20, 20}).value();
  EXPECT_EQ(resolution_map(round, ball, 100, 100).front(), 0);
}

}  // namespace
}  // namespace orbwatch::optics
