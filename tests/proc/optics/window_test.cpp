// SPDX-License-Identifier: Apache-2.0
#include "proc/optics/window.h"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "proc/optics/vec.h"

namespace orbwatch::optics {
namespace {

/// The exit point of a ray through the origin from a glass whose surfaces are z = 5 and z = 5 +
/// thickness, traced in the plane of incidence by the angles of Snell's law.
Vec3 traced_exit(const Vec3& direction, double thickness, double index) {
  const double across = std::hypot(direction.x, direction.y);
  const double outside = std::atan2(across, direction.z);
  const double inside = std::asin(std::sin(outside) / index);
  const double way = 5 * std::tan(outside) + thickness * std::tan(inside);
  if (across == 0) return {0, 0, 5 + thickness};
  return {direction.x / across * way, direction.y / across * way, 5 + thickness};
}

TEST(Window, DisplacesAsARayTracedThroughBothSurfaces) {
  std::mt19937 random(3);
  std::uniform_real_distribution<double> side(-2, 2), thickness(0, 30), index(1, 2.5);
  for (int i = 0; i < 500; ++i) {
    const Vec3 direction = normalized({side(random), side(random), 1});
    const Window window{{0, 0, -7}, thickness(random), index(random)};  // either side, any length
    const Vec3 exit = traced_exit(direction, window.thickness, window.index);
    const Vec3 undisturbed = direction * (exit.z / direction.z);
    const Vec3 shift = displacement(window, direction);
    EXPECT_LT(norm(shift - (exit - undisturbed)), 1e-12);
    EXPECT_NEAR(shift.z, 0, 1e-13) << "perpendicular to the normal";
  }
}

TEST(Window, ActsAsIfTheCameraStoodNearer) {
  // A glass of 10 mm and index 1.52 brings things 3.4 mm nearer, near its normal.
  const double slope = 0.001;
  const Vec3 shift = displacement({{0, 1, 0}, 10, 1.52}, normalized({slope, 1, 0}));
  EXPECT_NEAR(-shift.x / slope, 3.421, 0.001);
  EXPECT_EQ(shift.z, 0);
}

TEST(Window, TiltedShiftsTheAxisSideways) {
  const double tilt = radians(30);
  const Vec3 normal{std::sin(tilt), 0, std::cos(tilt)};
  const Vec3 axis{0, 0, 1};
  const Vec3 shift = displacement({normal, 10, 1.5}, axis);
  const Vec3 sideways = shift - axis * dot(shift, axis);
  // The textbook's plane-parallel plate: t sin(i - i') / cos i'.
  const double inside = std::asin(std::sin(tilt) / 1.5);
  EXPECT_NEAR(norm(sideways), 10 * std::sin(tilt - inside) / std::cos(inside), 1e-12);
}

TEST(Window, DoesNothingWithoutThicknessOrIndex) {
  const Vec3 direction = normalized({1, 2, 3});
  EXPECT_EQ(norm(displacement({{0, 0, 1}, 0, 1.5}, direction)), 0);
  EXPECT_LT(norm(displacement({{0, 0, 1}, 20, 1}, direction)), 1e-14);
  EXPECT_EQ(norm(displacement({{0, 0, 1}, 20, 1.5}, {1, 0, 0})), 0) << "never enters the glass";
}

TEST(Window, RefusesWhatIsNoGlass) {
  const double nan = std::nan(""), inf = std::numeric_limits<double>::infinity();
  EXPECT_TRUE(check_window({}));
  EXPECT_TRUE(check_window({{0, 0, 4}, 10, 5}));
  EXPECT_FALSE(check_window({{0, 0, 0}, 10, 1.5}));
  EXPECT_FALSE(check_window({{0, nan, 1}, 10, 1.5}));
  EXPECT_FALSE(check_window({{0, inf, 1}, 10, 1.5}));
  EXPECT_FALSE(check_window({{0, 0, 1}, -1, 1.5}));
  EXPECT_FALSE(check_window({{0, 0, 1}, inf, 1.5}));
  EXPECT_FALSE(check_window({{0, 0, 1}, 10, 0.9}));
  EXPECT_FALSE(check_window({{0, 0, 1}, 10, 5.1}));
  EXPECT_FALSE(check_window({{0, 0, 1}, 10, nan}));
}

}  // namespace
}  // namespace orbwatch::optics
