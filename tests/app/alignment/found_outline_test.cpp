// SPDX-License-Identifier: Apache-2.0
#include "app/alignment/found_outline.h"

#include <gtest/gtest.h>

#include <array>

#include "tests/proc/align/detect/painted_ball.h"
#include "tests/support/picture_of_mat.h"

namespace orbwatch::app {
namespace {

using orbwatch::tests::picture_of_mat;

/// A picture in which a ball is found, but not for sure.
cv::Mat noise_picture() {
  cv::Mat noise(300, 400, CV_8U);
  cv::theRNG().state = 5;
  cv::randn(noise, 120, 30);
  return noise;
}

TEST(FoundOutline, IsRefusedInOneWordingWhereTheBallIsNotSure) {
  const cv::Mat noise = noise_picture();
  const auto detected = align::detect_ball(picture_of_mat(noise));
  ASSERT_TRUE(detected) << detected.error().message;
  ASSERT_FALSE(detected->is_confident());
  const auto found = found_outline(picture_of_mat(noise));
  ASSERT_FALSE(found);
  const std::string doubt = "the ball is not found for sure: " + detected->reason;
  EXPECT_EQ(doubt_text(*detected), doubt);
  EXPECT_TRUE(found.error().message.starts_with(doubt + " (confidence 0."))
      << found.error().message;
  EXPECT_NE(found.error().message.find("`orbwatch detect --overlay`"), std::string::npos)
      << found.error().message;
}

TEST(FoundOutline, IsRefusedWhereThePictureShowsNothing) {
  const cv::Mat black(240, 320, CV_8U, cv::Scalar(0));
  const auto found = found_outline(picture_of_mat(black));
  ASSERT_FALSE(found);
  EXPECT_NE(found.error().message.find("no edges"), std::string::npos) << found.error().message;
}

TEST(FoundOutline, IsThatOfTheSurestPicture) {
  const cv::Mat black(240, 320, CV_8U, cv::Scalar(0)), noise = noise_picture();
  const cv::Mat ball = align::painted_ball(align::kPaintedSize, align::kPaintedLimb);
  const std::array pictures{picture_of_mat(black), picture_of_mat(noise), picture_of_mat(ball)};
  const auto surest = surest_ball(pictures);
  ASSERT_TRUE(surest) << surest.error().message;
  EXPECT_NEAR(surest->outline.centre.u, align::kPaintedLimb.centre.u, 1);
  EXPECT_NEAR(surest->outline.centre.v, align::kPaintedLimb.centre.v, 1);
  EXPECT_FALSE(surest_ball(std::span(pictures).first(1)));
}

}  // namespace
}  // namespace orbwatch::app
