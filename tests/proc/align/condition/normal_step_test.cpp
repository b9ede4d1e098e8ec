// SPDX-License-Identifier: Apache-2.0
#include "proc/align/condition/normal_step.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

namespace orbwatch::align {
namespace {

double share(double x) { return (1 + std::erf(x / std::numbers::sqrt2)) / 2; }
double density(double x) {
  return std::exp(-x * x / 2) * std::numbers::inv_sqrtpi / std::numbers::sqrt2;
}

TEST(NormalStep, IsWithinItsBoundEverywhere) {
  double worst_share = 0, worst_density = 0;
  // The step is no multiple of the nodes' distance.
  for (double x = -9; x <= 9; x += 0.000'37) {
    const NormalStep step = normal_step(x);
    worst_share = std::max(worst_share, std::abs(step.share - share(x)));
    worst_density = std::max(worst_density, std::abs(step.density - density(x)));
  }
  EXPECT_LT(worst_share, kNormalStepError);
  EXPECT_LT(worst_density, kNormalStepError);
  EXPECT_GT(worst_density, kNormalStepError / 5) << "the bound says little";
}

TEST(NormalStep, IsDefinedForEveryNumber) {
  constexpr double kEndless = std::numeric_limits<double>::infinity();
  EXPECT_NEAR(normal_step(-kEndless).share, 0, kNormalStepError);
  EXPECT_NEAR(normal_step(kEndless).share, 1, kNormalStepError);
  EXPECT_NEAR(normal_step(kEndless).density, 0, kNormalStepError);
  EXPECT_TRUE(std::isnan(normal_step(std::nan("")).share));
  EXPECT_TRUE(std::isnan(normal_step(std::nan("")).density));
}

}  // namespace
}  // namespace orbwatch::align
