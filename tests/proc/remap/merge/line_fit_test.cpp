// SPDX-License-Identifier: Apache-2.0
#include "proc/remap/merge/line_fit.h"

#include <gtest/gtest.h>

#include <cmath>
#include <random>
#include <vector>

namespace orbwatch::remap {
namespace {

/// Points on y = slope x + offset with x in [low, high] and normal noise on both sides.
std::vector<Measured> on_line(double slope, double offset, double low, double high, double noise,
                              int count = 2000) {
  std::mt19937 random(5);
  std::uniform_real_distribution<double> place(low, high);
  std::normal_distribution<double> error(0, 1);
  std::vector<Measured> measured;
  for (int i = 0; i < count; ++i) {
    const double x = place(random);
    measured.push_back(
        {x + noise * error(random), slope * (x + noise * error(random)) + offset, 1});
  }
  return measured;
}

TEST(LineFit, IsExactWithoutNoise) {
  for (const double slope : {0.07, 1.0, 14.0}) {
    auto measured = on_line(slope, -0.03, 0.1, 0.9, 0, 40);
    const auto line = fit_line(measured);
    ASSERT_TRUE(line);
    EXPECT_NEAR(line->slope, slope, 1e-9 * slope);
    EXPECT_NEAR(line->offset, -0.03, 1e-9 * slope);
  }
}

TEST(LineFit, FavoursNeitherSide) {
  // Noise of a third of the signal's spread: plain least squares would give 10 % too little.
  auto measured = on_line(2, 0.1, 0.2, 0.8, 0.06, 20000);
  const auto there = fit_line(measured);
  ASSERT_TRUE(there);
  EXPECT_NEAR(there->slope, 2, 0.02);
  for (auto& m : measured) std::swap(m.x, m.y);
  const auto back = fit_line(measured);
  ASSERT_TRUE(back);
  EXPECT_NEAR(back->slope * there->slope, 1, 0.005);
}

TEST(LineFit, ToleratesAFifthOfOutliersOnOneSide) {
  auto measured = on_line(1.6, 0.05, 0.1, 0.5, 0.002);
  for (std::size_t i = 0; i < measured.size(); i += 5) measured[i].y = 0.97;
  const auto line = fit_line(measured);
  ASSERT_TRUE(line);
  EXPECT_NEAR(line->slope, 1.6, 0.016);
  EXPECT_NEAR(line->offset, 0.05, 0.003);
  EXPECT_NEAR(line->weight, 0.8 * 2000, 0.25 * 1600) << "outliers do not count";
}

TEST(LineFit, WithoutContrastRunsThroughTheOrigin) {
  auto constant = on_line(0, 0.6, 0.3, 0.3, 0, 100);
  const auto line = fit_line(constant);
  ASSERT_TRUE(line);
  EXPECT_NEAR(line->slope, 2, 1e-12);
  EXPECT_NEAR(line->offset, 0, 1e-12);
  auto noisy = on_line(1.5, 0, 0.4, 0.4, 0.005);
  const auto through_noise = fit_line(noisy);
  ASSERT_TRUE(through_noise);
  EXPECT_NEAR(through_noise->slope, 1.5, 0.01);
  EXPECT_NEAR(through_noise->offset, 0, 1e-12);
}

TEST(LineFit, HeavierMeasurementsCountMore) {
  auto measured = on_line(1, 0, 0.2, 0.8, 0.01, 1000);
  const auto shifted = on_line(1, 0.02, 0.2, 0.8, 0.01, 1000);
  for (Measured m : shifted) {
    m.weight = 9;
    measured.push_back(m);
  }
  const auto line = fit_line(measured);
  ASSERT_TRUE(line);
  EXPECT_NEAR(line->slope * 0.5 + line->offset - 0.5, 0.018, 0.002);
}

TEST(LineFit, RefusesWhatIsNoLine) {
  auto few = on_line(1, 0, 0.1, 0.9, 0, 7);
  EXPECT_FALSE(fit_line(few));
  auto falling = on_line(-1, 1, 0.1, 0.9, 0.01);
  EXPECT_FALSE(fit_line(falling));
  auto unrelated = on_line(0, 0.5, 0.1, 0.9, 0);
  std::mt19937 random(3);
  for (auto& m : unrelated) m.y = std::uniform_real_distribution<double>(0.1, 0.9)(random);
  EXPECT_FALSE(fit_line(unrelated));
  auto black = on_line(0, 0, 0, 0, 0, 100);
  EXPECT_FALSE(fit_line(black));
}

}  // namespace
}  // namespace orbwatch::remap
