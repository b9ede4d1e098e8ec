#include "proc/align/detect/circle_search.h"

#include <gtest/gtest.h>

#include "proc/align/detect/centre_votes.h"
#include "tests/proc/align/detect/painted_ball.h"

namespace orbwatch::align {
namespace {

const optics::Outline kLimb{{132.3, 101.7}, 61, 61, 0};

class CircleSearch : public testing::Test {
 protected:
  const Slopes slopes = slopes_of(painted_ball({260, 200}, kLimb));
  const ReflectionLaw law;
};

TEST_F(CircleSearch, VotesMeetInTheBallsCentre) {
  const auto centres = centre_votes(slopes, 18, 80, 8);
  ASSERT_FALSE(centres.empty());
  EXPECT_LE(centres.size(), 8U);
  EXPECT_TRUE(std::ranges::any_of(centres, [](const optics::Vec2& c) {
    return std::hypot(c.u - kLimb.centre.u, c.v - kLimb.centre.v) < 0.12 * kLimb.rx;
  }));
}

TEST_F(CircleSearch, EvidenceIsHighestAtTheLimb) {
  const PolarEvidence evidence(slopes, law, kLimb.centre, 20, 110);
  const double limb = evidence(kLimb.rx + 1);
  EXPECT_GT(limb, 50);
  for (const double share : {0.5, 0.7, 0.85, 0.92, 1.1, 1.2, 1.5}) {
    EXPECT_LT(evidence(share * kLimb.rx), limb) << share;
  }
}

TEST_F(CircleSearch, ClimbsToTheLimbFromAround) {
  for (const auto [du, dv, dr] : {std::array{5.0, 0.0, -4.0}, {-4.0, 3.0, 5.0}, {0.0, -5.0, 2.0}}) {
    const Circle start{{kLimb.centre.u + du, kLimb.centre.v + dv}, kLimb.rx + dr, 0};
    const Circle found = climb(slopes, law, start, 0.1);
    EXPECT_NEAR(found.centre.u, kLimb.centre.u, 0.05 * kLimb.rx);
    EXPECT_NEAR(found.centre.v, kLimb.centre.v, 0.05 * kLimb.rx);
    EXPECT_NEAR(found.radius, kLimb.rx + 1, 0.05 * kLimb.rx);
  }
}

TEST(CircleSearchOfNothing, HasNoVotesAndNoEvidence) {
  const Slopes flat = slopes_of(cv::Mat(200, 260, CV_16U, cv::Scalar(7000)));
  EXPECT_TRUE(centre_votes(flat, 18, 80, 8).empty());
  EXPECT_EQ(PolarEvidence(flat, ReflectionLaw(), {130, 100}, 20, 80)(50), 0);
  // Beyond the picture, too.
  EXPECT_EQ(PolarEvidence(flat, ReflectionLaw(), {-400, 100}, 20, 80)(50), 0);
}

}  // namespace
}  // namespace orbwatch::align
