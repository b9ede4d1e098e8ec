// SPDX-License-Identifier: Apache-2.0
#include "app/watch/outline_check.h"

#include <gtest/gtest.h>

#include <cmath>
#include <opencv2/imgcodecs.hpp>

#include "tests/support/picture_of_mat.h"
#include "tests/support/reference_data.h"
#include "tests/support/rendered_scene.h"
#include "tests/support/rendered_sequence.h"

/// The check beside the true outline of rendered machines.
namespace orbwatch::app {
namespace {

class OutlineCheckTest : public testing::Test {
 protected:
  void SetUp() override {
    ORBWATCH_REQUIRE_FILE(orbwatch::tests::rendered_pictures());
    const orbwatch::tests::RenderedSequence sequence("seq_bump");
    picture_ = cv::imread(sequence.frames().front().picture.string(),
                          cv::IMREAD_ANYDEPTH | cv::IMREAD_ANYCOLOR);
    truth_ = sequence.camera().outline().value();
  }

  OutlineCheck check(const optics::Outline& stated) const {
    return check_outline(orbwatch::tests::picture_of_mat(picture_), stated);
  }

  cv::Mat picture_;
  optics::Outline truth_;
};

TEST_F(OutlineCheckTest, TheTrueOutlineIsAligned) {
  const OutlineCheck seen = check(truth_);
  EXPECT_EQ(seen.state, OutlineState::Aligned) << seen.doubt;
  EXPECT_LT(seen.offset_percent, 1);
  EXPECT_NEAR(seen.offset_px, seen.offset_percent / 100 * optics::mean_radius(truth_), 1e-9);
}

TEST_F(OutlineCheckTest, FivePerCentOfTheRadiusAreNotAligned) {
  const double radius = optics::mean_radius(truth_);
  optics::Outline larger = truth_, smaller = truth_, aside = truth_, above = truth_, oval = truth_;
  larger.rx *= 1.05;
  larger.ry *= 1.05;
  smaller.rx *= 0.95;
  smaller.ry *= 0.95;
  aside.centre.u += 0.05 * radius;
  above.centre.v -= 0.05 * radius;
  oval.ry *= 1.05;
  for (const optics::Outline& stated : {larger, smaller, aside, above, oval}) {
    const OutlineCheck seen = check(stated);
    EXPECT_EQ(seen.state, OutlineState::NotAligned) << seen.doubt;
    EXPECT_NEAR(seen.offset_percent, 5, 1);
  }
}

TEST_F(OutlineCheckTest, WithoutABallItIsUnknownAndSaysWhy) {
  picture_ = cv::Mat(480, 640, CV_8U);
  cv::RNG(1).fill(picture_, cv::RNG::UNIFORM, 60, 120);
  const OutlineCheck seen = check({{320, 240}, 100, 100, 0});
  EXPECT_EQ(seen.state, OutlineState::Unknown);
  EXPECT_FALSE(seen.doubt.empty());
  EXPECT_TRUE(std::isnan(seen.offset_percent));
}

}  // namespace
}  // namespace orbwatch::app
