// SPDX-License-Identifier: Apache-2.0
#include "proc/align/detect/ring/ring_search.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "proc/align/detect/centre_votes.h"
#include "proc/align/detect/ring/ring_strip.h"
#include "tests/proc/align/detect/painted_ball.h"

namespace orbwatch::align {
namespace {

const optics::Outline kTinyLimb{{72.3, 51.7}, 26, 26, 0};
const cv::Size kTinySize(140, 104);

TEST(CentreVotes, MeetInTheBallsCentre) {
  const auto centres = centre_votes(slopes_of(painted_ball(kTinySize, kTinyLimb)),
                                    RingStrip::kNearest, RingStrip::kFarthest, 8);
  ASSERT_FALSE(centres.empty());
  EXPECT_LE(centres.size(), 8U);
  EXPECT_TRUE(std::ranges::any_of(centres, [](const optics::Vec2& c) {
    return std::hypot(c.u - kTinyLimb.centre.u, c.v - kTinyLimb.centre.v) < 0.2 * kTinyLimb.rx;
  }));
}

TEST(CentreVotes, AreNoneWhereNothingIsSeen) {
  EXPECT_TRUE(
      centre_votes(slopes_of(cv::Mat(200, 260, CV_16U, cv::Scalar(7000))), 15, 38, 8).empty());
}

TEST(RingStrip, UnrollsCirclesToColumns) {
  // A disc's edge is in one column.
  cv::Mat disc(kTinySize, CV_8U, cv::Scalar(20));
  cv::circle(disc, {70, 52}, 24, cv::Scalar(200), cv::FILLED);
  const RingStrip strip(disc, {70, 52});
  for (int ray = 0; ray < strip.rays(); ++ray) {
    int steepest = 0;
    for (int k = 0; k < strip.columns(); ++k) {
      const auto slope = strip.slope(ray, k);
      ASSERT_TRUE(slope);
      if (slope->along < strip.slope(ray, steepest)->along) steepest = k;
    }
    EXPECT_NEAR(RingStrip::radius(steepest), 24.5, 1.5) << ray;
  }
}

Ring likeliest(const cv::Mat& luminance, optics::Vec2 place) {
  return likeliest_rings(luminance, place, 1).at(0);
}

TEST(RingSearch, FindsTheLimbFromAround) {
  const cv::Mat ball = painted_ball(kTinySize, kTinyLimb);
  for (const auto [du, dv] : {std::array{0.0, 0.0}, {4.0, 0.0}, {-3.0, 3.0}, {0.0, -5.0}}) {
    const Ring ring = likeliest(ball, {kTinyLimb.centre.u + du, kTinyLimb.centre.v + dv});
    EXPECT_NEAR(ring.centre.u, kTinyLimb.centre.u, 0.08 * kTinyLimb.rx) << du << " " << dv;
    EXPECT_NEAR(ring.centre.v, kTinyLimb.centre.v, 0.08 * kTinyLimb.rx) << du << " " << dv;
    EXPECT_NEAR(ring.radius, kTinyLimb.rx, 0.08 * kTinyLimb.rx) << du << " " << dv;
    EXPECT_GT(ring.likeness, 0.5);
  }
}

TEST(RingSearch, FindsWhatElseIsAround) {
  const auto apart = [](const Ring& a, const Ring& b) {
    const double centres = std::hypot(a.centre.u - b.centre.u, a.centre.v - b.centre.v);
    return std::max(centres, std::abs(a.radius - b.radius)) / std::min(a.radius, b.radius);
  };
  const auto rings = likeliest_rings(painted_ball(kTinySize, kTinyLimb), kTinyLimb.centre, 4);
  ASSERT_EQ(rings.size(), 4U);
  for (std::size_t i = 0; i < rings.size(); ++i) {
    for (std::size_t j = 0; j < i; ++j) {
      EXPECT_LE(rings[i].likeness, rings[j].likeness);
      EXPECT_GE(apart(rings[i], rings[j]), 0.1);
    }
  }
}

TEST(RingSearch, IsLessLikelyInNoise) {
  cv::Mat noise(kTinySize, CV_8U);
  cv::theRNG().state = 5;
  cv::randn(noise, 120, 30);
  const double ball = likeliest(painted_ball(kTinySize, kTinyLimb), kTinyLimb.centre).likeness;
  EXPECT_LT(likeliest(noise, {70, 52}).likeness, ball);
  // The place may also be beyond the picture.
  EXPECT_LT(likeliest(noise, {-400, 52}).likeness, ball);
}

}  // namespace
}  // namespace orbwatch::align
