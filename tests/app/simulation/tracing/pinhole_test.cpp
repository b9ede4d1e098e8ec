// SPDX-License-Identifier: Apache-2.0
#include "app/simulation/tracing/pinhole.h"

#include <gtest/gtest.h>

#include <numbers>

#include "tests/app/simulation/projection.h"
#include "tests/app/simulation/random_geometry.h"

namespace orbwatch::app::simulation {
namespace {

using optics::Vec2;

TEST(Pinhole, LooksAtItsTargetWithUpTowardsZ) {
  RandomGeometry random;
  for (int i = 0; i < 100; ++i) {
    const Vec3 position = kBall.centre + random.direction() * random.number(100, 700);
    const Pinhole camera = look_at(position, kBall.centre, 20, 640, 481);
    const Vec2 centre = project(camera, kBall.centre);
    EXPECT_NEAR(centre.u, 319.5, 1e-9);
    EXPECT_NEAR(centre.v, 240, 1e-9);
    const Vec2 above = project(camera, kBall.centre + Vec3{0, 0, 1});
    EXPECT_NEAR(above.u, 319.5, 1e-9);
    EXPECT_LT(above.v, 240);
    EXPECT_NEAR(dot(cross(camera.rotation.row0, camera.rotation.row1), camera.rotation.row2), 1,
                1e-12);
  }
}

TEST(Pinhole, SeesItsFieldOfViewFromEdgeToEdge) {
  const Pinhole camera = look_at({0, 0, 0}, {0, 100, 0}, 90, 200, 100);
  EXPECT_NEAR(camera.focal_length, 100, 1e-9);
  const Ray edge = camera.ray_through(-0.5, camera.cy());
  EXPECT_NEAR(optics::angle_between(edge.direction, {0, 1, 0}), std::numbers::pi / 4, 1e-12);
  EXPECT_LT(edge.direction.x, 0);
}

TEST(Pinhole, CastsRaysThroughTheirPixels) {
  RandomGeometry random;
  const Pinhole camera = look_at({-300, 200, 700}, kBall.centre, 40, 320, 256);
  for (int i = 0; i < 100; ++i) {
    const Vec2 pixel{random.number(0, 319), random.number(0, 255)};
    const Ray ray = camera.ray_through(pixel.u, pixel.v);
    const Vec2 back = project(camera, ray.at(random.number(10, 1000)));
    EXPECT_NEAR(back.u, pixel.u, 1e-9);
    EXPECT_NEAR(back.v, pixel.v, 1e-9);
    EXPECT_NEAR(norm(ray.direction), 1, 1e-12);
  }
}

TEST(Pinhole, StandsUprightWhenItLooksStraightDown) {
  const Pinhole camera = look_at({0, 0, 100}, {0, 0, 0}, 40, 100, 100);
  EXPECT_NEAR(camera.rotation.row0.x, 1, 1e-12);
  EXPECT_NEAR(camera.rotation.row1.y, -1, 1e-12);
}

}  // namespace
}  // namespace orbwatch::app::simulation
