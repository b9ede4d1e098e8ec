// SPDX-License-Identifier: Apache-2.0
#include "proc/align/rotation_fit.h"

#include <gtest/gtest.h>

#include <random>
#include <vector>

#include "proc/optics/rotation.h"

namespace orbwatch::align {
namespace {

using optics::degrees;
using optics::Mat3;
using optics::radians;
using optics::Vec3;

TEST(RotationFit, TwoPairsDetermineIt) {
  std::mt19937 random(1);
  std::normal_distribution<double> any;
  std::uniform_real_distribution<double> angle(-180, 180);
  for (int n = 0; n < 200; ++n) {
    const Mat3 truth = optics::rotation({angle(random), angle(random) / 2, angle(random)});
    std::vector<DirectionPair> pairs;
    for (int i = 0; i < 2; ++i) {
      const Vec3 direction = optics::normalized({any(random), any(random), any(random)});
      pairs.push_back({truth * direction, direction});
    }
    if (std::abs(dot(pairs[0].camera, pairs[1].camera)) > 0.99) continue;
    const Mat3 found = fit_rotation(pairs);
    EXPECT_TRUE(optics::checked_rotation(found)) << "no mirror image";
    EXPECT_LT(angle_between(found, truth), 1e-9);
  }
}

TEST(RotationFit, AHeavyPairCountsMore) {
  const double off = radians(1);
  const std::vector<DirectionPair> pairs{{{1, 0, 0}, {1, 0, 0}, 3},
                                         {{0, 0, 1}, {0, 0, 1}, 100},
                                         {{0, 1, 0}, {std::sin(off), std::cos(off), 0}, 1}};
  EXPECT_NEAR(degrees(angle_between(fit_rotation(pairs), Mat3{})), 0.25, 0.01);
}

TEST(RotationFit, ATurnIsRightHandedAndItsAngleIsRecovered) {
  const Vec3 turned = rotation_about({0, 0, radians(90)}) * Vec3{1, 0, 0};
  EXPECT_NEAR(turned.y, 1, 1e-12);
  for (const double angle : {0.0, 1e-7, 0.1, 90.0, 179.9}) {
    const Mat3 turn = rotation_about(optics::normalized({1, 2, 3}) * radians(angle));
    EXPECT_NEAR(degrees(angle_between(turn, Mat3{})), angle, 1e-6);
  }
}

}  // namespace
}  // namespace orbwatch::align
