// SPDX-License-Identifier: Apache-2.0
#include "app/cli/setup/stated_rotation.h"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "proc/align/rotation_fit.h"
#include "proc/optics/rotation.h"

namespace orbwatch::tests {
namespace {

using app::cli::stated_rotation;
using optics::Mat3;
using optics::Vec3;

Mat3 random_rotation(std::mt19937_64& random) {
  std::uniform_real_distribution<double> angle(-180, 180);
  return optics::rotation({angle(random), angle(random) / 2, angle(random)});
}

Mat3 rounded(const Mat3& matrix, int decimals) {
  const double scale = std::pow(10, decimals);
  const auto row = [&](const Vec3& v) {
    return Vec3{std::round(v.x * scale) / scale, std::round(v.y * scale) / scale,
                std::round(v.z * scale) / scale};
  };
  return {row(matrix.row0), row(matrix.row1), row(matrix.row2)};
}

TEST(StatedRotation, RestoresWhatFourDecimalsRounded) {
  std::mt19937_64 random(1);
  for (int n = 0; n < 1000; ++n) {
    const Mat3 truth = random_rotation(random);
    const auto stated = stated_rotation(rounded(truth, 4));
    ASSERT_TRUE(stated) << stated.error().message;
    EXPECT_TRUE(optics::checked_rotation(stated->rotation));
    // sqrt(2) times the norm of the roundings, in degrees.
    EXPECT_LT(optics::degrees(align::angle_between(stated->rotation, truth)), 0.0122);
    EXPECT_LT(stated->change, 0.0086);
  }
}

TEST(StatedRotation, KeepsARotationAsItIs) {
  std::mt19937_64 random(2);
  const Mat3 truth = random_rotation(random);
  const auto stated = stated_rotation(truth);
  ASSERT_TRUE(stated);
  EXPECT_EQ(stated->rotation.row1.y, truth.row1.y);
  EXPECT_EQ(stated->change, 0);
}

TEST(StatedRotation, AcceptsDecimalsThatAreCutOff) {
  // Cut towards zero, all elements lose up to 1e-4.
  const Mat3 cut{{0.9986, -0.0523, 0}, {0.0523, 0.9986, 0}, {0, 0, 1}};  // 3 degrees
  const auto stated = stated_rotation(cut);
  ASSERT_TRUE(stated) << stated.error().message;
  EXPECT_LT(optics::degrees(align::angle_between(stated->rotation, optics::rotation({-3, 0, 0}))),
            0.01);
}

TEST(StatedRotation, ReportsTheTurnOfTheAxisThatChangedMost) {
  // The first two axes lean towards each other by 1e-4 rad in all: the nearest rotation shares it.
  const auto stated = stated_rotation({{1, 1e-4, 0}, {0, 1, 0}, {0, 0, 1}});
  ASSERT_TRUE(stated) << stated.error().message;
  EXPECT_NEAR(stated->change, optics::degrees(0.5e-4), 1e-6);
}

TEST(StatedRotation, RefusesWhatRoundingDoesNotExplain) {
  std::mt19937_64 random(3);
  for (const Mat3& matrix :
       {rounded(random_rotation(random), 2), Mat3{{1, 0, 0}, {0, 1, 0}, {0, 0, -1}},
        Mat3{{1.002, 0, 0}, {0, 1, 0}, {0, 0, 1}}, Mat3{{0, 0, 0}, {0, 0, 0}, {0, 0, 0}}}) {
    const auto stated = stated_rotation(matrix);
    ASSERT_FALSE(stated);
    EXPECT_NE(stated.error().message.find("four decimals"), std::string::npos);
  }
}

}  // namespace
}  // namespace orbwatch::tests
