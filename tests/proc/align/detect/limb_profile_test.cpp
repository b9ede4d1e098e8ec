#include "proc/align/detect/limb_profile.h"

#include <gtest/gtest.h>

#include "proc/align/detect/limb_likelihood.h"
#include "tests/proc/align/detect/painted_ball.h"

namespace orbwatch::align {
namespace {

const optics::Outline kLimb{{132.3, 101.7}, 80, 80, 0};

TEST(LimbProfile, TellsKindsByShareAndEnergy) {
  using limb_profile::kind;
  EXPECT_EQ(kind({0.1F, 0.5F}, 1), 0U);
  EXPECT_EQ(kind({0.5F, 0.1F}, 1), limb_profile::kKinds - limb_profile::kEnergies);
  EXPECT_EQ(kind({0.1F, 1.5F}, 1), 1U);
  EXPECT_EQ(kind({0.1F, 2.1F}, 1), 2U);
  EXPECT_EQ(kind({1000, 0}, 1), limb_profile::kKinds - 1);
}

TEST(LimbProfile, IsInsideWhatIsStrongAlongTheNormal) {
  const auto& strong = limb_profile::at(limb_profile::kind({30, 0}, 1));
  const auto& weak = limb_profile::at(limb_profile::kind({0.1F, 0.5F}, 1));
  EXPECT_GT(strong.front(), strong.back() + 1);
  EXPECT_GT(weak.back(), weak.front() + 1);
  // Nothing is as strong as what is on the limb.
  EXPECT_GT(strong[limb_profile::kFarthest], strong.front());
}

TEST(LimbLikelihood, IsHighOnABallAndRandomOnNoise) {
  const cv::Mat ball = painted_ball({264, 204}, kLimb);
  EXPECT_GT(LimbLikelihood(LimbStrip(ball, kLimb, 8), kLimb, ball.size()).above_random({}), 1.5);
  const optics::Outline smaller{kLimb.centre, 74, 74, 0};
  EXPECT_LT(LimbLikelihood(LimbStrip(ball, smaller, 8), smaller, ball.size()).above_random({}), 0);
  cv::Mat noise(ball.size(), CV_8U);
  cv::theRNG().state = 5;
  cv::randn(noise, 120, 30);
  EXPECT_LT(LimbLikelihood(LimbStrip(noise, kLimb, 8), kLimb, noise.size()).above_random({}), 0.3);
}

}  // namespace
}  // namespace orbwatch::align
