// SPDX-License-Identifier: Apache-2.0
#include "proc/optics/rotation.h"

#include <gtest/gtest.h>

#include <random>

#include "proc/optics/vec.h"

namespace orbwatch::optics {
namespace {

void expect_near(const Vec3& a, const Vec3& b, double tolerance = 1e-12) {
  EXPECT_NEAR(a.x, b.x, tolerance);
  EXPECT_NEAR(a.y, b.y, tolerance);
  EXPECT_NEAR(a.z, b.z, tolerance);
}

TEST(Rotation, FollowsTheConventions) {
  const double c = std::cos(radians(10)), s = std::sin(radians(10));
  expect_near(rotation({0, 0, 10}).column0(), {c, 0, -s});  // the right side dips
  expect_near(rotation({10, 0, 0}).column1(), {s, c, 0});   // yaw towards +X
  expect_near(rotation({0, 10, 0}).column1(), {0, c, s});   // pitch up
  expect_near(rotation({90, 20, 0}).column1(), {std::cos(radians(20)), 0, std::sin(radians(20))});
}

TEST(Rotation, AnglesAreRecovered) {
  std::mt19937 random(1);
  std::uniform_real_distribution<double> wide(-179, 179), steep(-89, 89);
  for (int i = 0; i < 1000; ++i) {
    const YawPitchRoll angles{wide(random), steep(random), wide(random)};
    const Mat3 matrix = rotation(angles);
    ASSERT_TRUE(checked_rotation(matrix));
    const YawPitchRoll again = yaw_pitch_roll(matrix);
    EXPECT_NEAR(again.yaw, angles.yaw, 1e-9);
    EXPECT_NEAR(again.pitch, angles.pitch, 1e-9);
    EXPECT_NEAR(again.roll, angles.roll, 1e-9);
  }
  const YawPitchRoll up = yaw_pitch_roll(rotation({30, 90, 0}));
  EXPECT_NEAR(up.yaw, 30, 1e-6);
  EXPECT_NEAR(up.pitch, 90, 1e-6);
}

TEST(Rotation, RefusesOtherMatrices) {
  EXPECT_FALSE(checked_rotation({{1, 0, 0}, {0, 1, 0}, {0, 0, -1}})) << "mirrors";
  EXPECT_FALSE(checked_rotation({{1, 0, 0}, {0, 1.001, 0}, {0, 0, 1}})) << "scales";
  EXPECT_FALSE(checked_rotation({{1, 0.01, 0}, {0, 1, 0}, {0, 0, 1}})) << "shears";
  EXPECT_FALSE(checked_rotation({{std::nan(""), 0, 0}, {0, 1, 0}, {0, 0, 1}}));
  EXPECT_FALSE(checked_rotation({{0, 0, 0}, {0, 0, 0}, {0, 0, 0}}));
}

TEST(Rotation, YawAndPitchOfADirectionPointThere) {
  for (const YawPitchRoll angles : {YawPitchRoll{30, 40, 0}, YawPitchRoll{-170, -80, 0}}) {
    const YawPitchRoll found = yaw_pitch(rotation(angles) * Vec3{0, 1, 0});
    EXPECT_NEAR(found.yaw, angles.yaw, 1e-9);
    EXPECT_NEAR(found.pitch, angles.pitch, 1e-9);
    EXPECT_EQ(found.roll, 0);
  }
  EXPECT_NEAR(yaw_pitch({0, 0, 1 + 1e-16}).pitch, 90, 1e-6);
}

}  // namespace
}  // namespace orbwatch::optics
