// SPDX-License-Identifier: Apache-2.0
#include "tests/app/simulation/camera_truth.h"

#include <gtest/gtest.h>

#include "tests/app/simulation/projection.h"
#include "tests/app/simulation/random_geometry.h"

namespace orbwatch::app::simulation {
namespace {

using optics::Mat3;
using optics::Vec2;

TEST(CameraTruth, OutlineHoldsEveryPointOfTheLimb) {
  RandomGeometry random;
  for (int i = 0; i < 20; ++i) {
    const Vec3 position = kBall.centre + random.direction() * random.number(120, 700);
    const Pinhole camera = look_at(position, kBall.centre, 30, 640, 480);
    const CameraTruth truth = truth_of(camera, kBall);
    const Vec3 to_camera = camera.position - kBall.centre;
    const double d = norm(to_camera) / kBall.radius;
    for (int j = 0; j < 12; ++j) {
      // On the limb the line of sight is perpendicular to the radius.
      const Vec3 side = normalized(cross(to_camera, random.direction()));
      const Vec3 limb = kBall.centre + (to_camera * (1 / norm(to_camera)) * (1 / d) +
                                        side * std::sqrt(1 - 1 / (d * d))) *
                                           kBall.radius;
      ASSERT_NEAR(dot(limb - kBall.centre, limb - camera.position), 0, 1e-8);
      const Vec2 pixel = project(camera, limb);
      ASSERT_NEAR(std::hypot(pixel.u - truth.outline.cx, pixel.v - truth.outline.cy),
                  truth.outline.radius, 1e-8);
    }
  }
}

TEST(CameraTruth, AlphaIsTheKnownOneAtKnownDistances) {
  // Distance in radii and alpha in degrees, as printed beside the reference renders.
  for (const auto& [d, alpha] : {std::pair{12.0, 350.4396163056017},
                                 {8.0, 345.6384884370834},
                                 {7.0, 343.57357859652365},
                                 {24.0, 355.22396907346246}}) {
    const Pinhole camera = look_at(kBall.centre + Vec3{0, -50 * d, 0}, kBall.centre, 30, 640, 480);
    EXPECT_NEAR(truth_of(camera, kBall).alpha, alpha, 1e-9);
  }
}

void expect_equal(const Mat3& a, const Mat3& b) {
  EXPECT_NEAR(norm(a.row0 - b.row0) + norm(a.row1 - b.row1) + norm(a.row2 - b.row2), 0, 1e-9);
}

TEST(CameraTruth, RotationIsNoneForACameraThatStandsAsIfUncalibrated) {
  const Pinhole camera = look_at(kBall.centre + Vec3{0, 400, 0}, kBall.centre, 20, 640, 480);
  expect_equal(truth_of(camera, kBall).rotation, Mat3{});
}

TEST(CameraTruth, RotationTakesUncalibratedDirectionsIntoTheMachine) {
  RandomGeometry random;
  for (int i = 0; i < 50; ++i) {
    const Vec3 position = kBall.centre + random.direction() * 400;
    const Pinhole camera = look_at(position, kBall.centre, 20, 640, 480);
    const Mat3 rotation = truth_of(camera, kBall).rotation;
    // Frame without a calibration: +Y points to the camera, -X to its right, +Z up.
    EXPECT_NEAR(norm(rotation * Vec3{0, 1, 0} - normalized(position - kBall.centre)), 0, 1e-9);
    EXPECT_NEAR(norm(rotation * Vec3{-1, 0, 0} - camera.rotation.row0), 0, 1e-9);
    EXPECT_NEAR(norm(rotation * Vec3{0, 0, 1} + camera.rotation.row1), 0, 1e-9);
  }
}

}  // namespace
}  // namespace orbwatch::app::simulation
