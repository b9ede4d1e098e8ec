// SPDX-License-Identifier: Apache-2.0
#include "proc/align/detect/limb/limb_network.h"

#include <gtest/gtest.h>

#include <numeric>

#include "proc/align/detect/limb/limb_likelihood.h"
#include "tests/proc/align/detect/painted_ball.h"

namespace orbwatch::align {
namespace {

double likeness(const cv::Mat& picture, const optics::Outline& outline) {
  return LimbLikelihood(LimbStrip(picture, outline, 8), outline, picture.size()).above_random();
}

/// The most probable column, all parts together.
int likeliest_column(const LimbColumns& limb) {
  std::vector<float> sums(static_cast<std::size_t>(limb.columns));
  for (int n = 0; n < limb.parts; ++n) {
    for (std::size_t k = 0; k < sums.size(); ++k) sums[k] += limb.part(n)[k];
  }
  return static_cast<int>(std::ranges::max_element(sums) - sums.begin());
}

TEST(LimbNetwork, GivesEachPartProbabilities) {
  const LimbStrip strip(painted_ball(kSmallSize, kSmallLimb), kSmallLimb, 8);
  const LimbColumns limb = limb_columns(strip);
  EXPECT_EQ(limb.columns, strip.columns());
  EXPECT_EQ(limb.parts * LimbColumns::kRays, strip.rays());
  for (int n = 0; n < limb.parts; ++n) {
    for (int k = 0; k < limb.columns; ++k) EXPECT_GE(limb.part(n)[k], 0);
    EXPECT_LE(std::accumulate(limb.part(n), limb.part(n) + limb.columns, 0.F), 1.0001F);
  }
}

TEST(LimbNetwork, SeesTheLimbWhereItIs) {
  const cv::Mat ball = painted_ball(kSmallSize, kSmallLimb);
  for (const int off : {-3, 0, 3}) {
    const optics::Outline outline{kSmallLimb.centre, kSmallLimb.rx + off, kSmallLimb.ry + off, 0};
    const LimbStrip strip(ball, outline, 8);
    const int seen = likeliest_column(limb_columns(strip)) - strip.limb();
    EXPECT_NEAR(seen, -off * LimbStrip::kPerUnit, 2) << off;
  }
}

TEST(LimbNetwork, SeesTheSameInAnyWidthOfStrip) {
  const cv::Mat ball = painted_ball(kSmallSize, kSmallLimb);
  for (const double reach : {3.0, 5.5, 6.0, 11.0, 12.5}) {
    const LimbStrip strip(ball, kSmallLimb, reach);
    EXPECT_NEAR(likeliest_column(limb_columns(strip)), strip.limb(), 2) << reach;
  }
}

TEST(LimbLikelihood, IsHighOnABallOnly) {
  const cv::Mat ball = painted_ball(kSmallSize, kSmallLimb);
  EXPECT_GT(likeness(ball, kSmallLimb), 0.5);
  EXPECT_LT(likeness(ball, {kSmallLimb.centre, 70, 70, 0}), -0.5);
  cv::Mat noise(ball.size(), CV_8U);
  cv::theRNG().state = 5;
  cv::randn(noise, 120, 30);
  EXPECT_LT(likeness(noise, kSmallLimb), -0.5);
}

}  // namespace
}  // namespace orbwatch::align
