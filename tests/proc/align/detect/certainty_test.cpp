// SPDX-License-Identifier: Apache-2.0
#include "proc/align/detect/certainty.h"

#include <gtest/gtest.h>

namespace orbwatch::align {
namespace {

/// Evidence of a ball in a good picture.
const LimbEvidence kBallEvidence{100, 0.5, 0.75, 2.2};

TEST(Certainty, IsHighWhenEverythingSpeaksForABall) {
  EXPECT_GT(certainty(kBallEvidence), kCertain + 1);
}

TEST(Certainty, FallsWithEachThingThatSpeaksAgainst) {
  const auto with = [](double LimbEvidence::*figure, double value) {
    LimbEvidence evidence = kBallEvidence;
    evidence.*figure = value;
    return certainty(evidence);
  };
  EXPECT_LT(with(&LimbEvidence::radius, 20), certainty(kBallEvidence));
  EXPECT_LT(with(&LimbEvidence::near_drop, 0.1), certainty(kBallEvidence));
  EXPECT_LT(with(&LimbEvidence::likelihood, 1.2), certainty(kBallEvidence));
  EXPECT_LT(with(&LimbEvidence::contour, 0.95), certainty(kBallEvidence));
}

TEST(Certainty, IsNeverThereForARimThatDoesNotEndAsABallDoes) {
  LimbEvidence rim = kBallEvidence;
  rim.near_drop = 1;
  rim.likelihood = 0.99 * kLeastLikelihood;
  EXPECT_LT(certainty(rim), 0);
}

TEST(Certainty, IsNeverThereForWhatIsTooSmall) {
  LimbEvidence small = kBallEvidence;
  small.near_drop = 1;
  small.radius = 0.99 * kLeastRadius;
  EXPECT_LT(certainty(small), 0);
}

TEST(Certainty, TakesASharpEdgeOnlyFromWhatIsVeryMuchLikeABall) {
  LimbEvidence sharp = kBallEvidence;
  sharp.contour = 0.95;
  sharp.likelihood = 3;
  EXPECT_GT(certainty(sharp), kCertain);
  sharp.likelihood = 1.5;
  EXPECT_LT(certainty(sharp), kCertain);
}

}  // namespace
}  // namespace orbwatch::align
