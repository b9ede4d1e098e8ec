#include "app/simulation/camera_truth.h"

#include <gtest/gtest.h>

#include <numbers>

#include "tests/app/simulation/random_geometry.h"

namespace orbwatch::app::simulation {
namespace {

using optics::Mat3;
using optics::Vec2;

const Sphere kBall{{120, 60, 430}, 50};

Vec2 project(const Pinhole& camera, const Vec3& point) {
  const Vec3 c = camera.rotation * (point - camera.position);
  return {camera.focal_length * c.x / c.z + camera.cx(),
          camera.focal_length * c.y / c.z + camera.cy()};
}

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

Mat3 matrix(const std::array<double, 9>& m) {
  return {{m[0], m[1], m[2]}, {m[3], m[4], m[5]}, {m[6], m[7], m[8]}};
}

/// Yaw, pitch, roll composed from elementary turns, in degrees.
Mat3 composed(double yaw, double pitch, double roll) {
  const auto c = [](double degrees) { return std::cos(degrees * std::numbers::pi / 180); };
  const auto s = [](double degrees) { return std::sin(degrees * std::numbers::pi / 180); };
  const Mat3 about_z{{c(yaw), s(yaw), 0}, {-s(yaw), c(yaw), 0}, {0, 0, 1}};
  const Mat3 about_x{{1, 0, 0}, {0, c(pitch), -s(pitch)}, {0, s(pitch), c(pitch)}};
  const Mat3 about_y{{c(roll), 0, s(roll)}, {0, 1, 0}, {-s(roll), 0, c(roll)}};
  return about_z * about_x * about_y;
}

void expect_equal(const Mat3& a, const Mat3& b) {
  EXPECT_NEAR(norm(a.row0 - b.row0) + norm(a.row1 - b.row1) + norm(a.row2 - b.row2), 0, 1e-9);
}

TEST(CameraTruth, RotationIsNoneForACameraThatStandsAsIfUncalibrated) {
  const Pinhole camera = look_at(kBall.centre + Vec3{0, 400, 0}, kBall.centre, 20, 640, 480);
  const CameraTruth truth = truth_of(camera, kBall);
  expect_equal(matrix(truth.rotation), Mat3{});
  EXPECT_NEAR(truth.yaw, 0, 1e-9);
  EXPECT_NEAR(truth.pitch, 0, 1e-9);
  EXPECT_NEAR(truth.roll, 0, 1e-9);
}

TEST(CameraTruth, RotationTakesUncalibratedDirectionsIntoTheMachine) {
  RandomGeometry random;
  for (int i = 0; i < 50; ++i) {
    const Vec3 position = kBall.centre + random.direction() * 400;
    const Pinhole camera = look_at(position, kBall.centre, 20, 640, 480);
    const Mat3 rotation = matrix(truth_of(camera, kBall).rotation);
    // Uncalibrated: +Y is where the camera stands, -X its right, +Z its up.
    EXPECT_NEAR(norm(rotation * Vec3{0, 1, 0} - normalized(position - kBall.centre)), 0, 1e-9);
    EXPECT_NEAR(norm(rotation * Vec3{-1, 0, 0} - camera.rotation.row0), 0, 1e-9);
    EXPECT_NEAR(norm(rotation * Vec3{0, 0, 1} + camera.rotation.row1), 0, 1e-9);
  }
}

TEST(CameraTruth, AnglesComposeToTheRotation) {
  RandomGeometry random;
  for (int i = 0; i < 50; ++i) {
    const Mat3 wanted =
        composed(random.number(-180, 180), random.number(-89, 89), random.number(-180, 180));
    // The camera whose registration this is: its axes are -X, -Z and -Y of the turned frame.
    const Pinhole camera{kBall.centre + wanted.column1() * 400,
                         {-wanted.column0(), -wanted.column2(), -wanted.column1()},
                         640,
                         480,
                         1000};
    const CameraTruth truth = truth_of(camera, kBall);
    expect_equal(matrix(truth.rotation), wanted);
    expect_equal(composed(truth.yaw, truth.pitch, truth.roll), wanted);
  }
  expect_equal(composed(0, 0, 10),
               Mat3{{std::cos(std::numbers::pi / 18), 0, std::sin(std::numbers::pi / 18)},
                    {0, 1, 0},
                    {-std::sin(std::numbers::pi / 18), 0, std::cos(std::numbers::pi / 18)}});
}

TEST(CameraTruth, AnglesComposeAtThePolesToo) {
  for (const double up : {400.0, -400.0}) {
    const Pinhole camera = look_at(kBall.centre + Vec3{0, 0, up}, kBall.centre, 20, 640, 480);
    const CameraTruth truth = truth_of(camera, kBall);
    EXPECT_NEAR(truth.pitch, up > 0 ? 90 : -90, 1e-6);
    expect_equal(composed(truth.yaw, truth.pitch, truth.roll), matrix(truth.rotation));
  }
}

}  // namespace
}  // namespace orbwatch::app::simulation
