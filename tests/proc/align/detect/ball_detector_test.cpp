// SPDX-License-Identifier: Apache-2.0
#include "proc/align/detect/ball_detector.h"

#include <gtest/gtest.h>

#include <opencv2/imgproc.hpp>

#include "tests/proc/align/detect/painted_ball.h"
#include "tests/support/picture_of_mat.h"

namespace orbwatch::align {
namespace {

using tests::picture_of_mat;

void expect_limb(const Result<BallDetection>& found) {
  ASSERT_TRUE(found) << found.error().message;
  EXPECT_NEAR(found->outline.centre.u, kPaintedLimb.centre.u, 0.01 * kPaintedLimb.rx);
  EXPECT_NEAR(found->outline.centre.v, kPaintedLimb.centre.v, 0.01 * kPaintedLimb.rx);
  EXPECT_NEAR((found->outline.rx + found->outline.ry) / 2, kPaintedLimb.rx, 0.01 * kPaintedLimb.rx);
  EXPECT_EQ(found->is_confident(), found->reason.empty());
}

TEST(BallDetector, FindsABallInEveryKindOfPicture) {
  const cv::Mat grey = painted_ball(kPaintedSize, kPaintedLimb);
  expect_limb(detect_ball(picture_of_mat(grey)));
  cv::Mat thermal;
  grey.convertTo(thermal, CV_16U, 3, 7300);  // 31 K in 40 mK steps
  expect_limb(detect_ball(picture_of_mat(thermal)));
}

TEST(BallDetector, RefusesPicturesThatShowNothing) {
  const cv::Mat black(240, 320, CV_8U, cv::Scalar(0));
  const auto nothing = detect_ball(picture_of_mat(black));
  ASSERT_FALSE(nothing);
  EXPECT_NE(nothing.error().message.find("no edges"), std::string::npos);
  const auto small = detect_ball(picture_of_mat(black(cv::Rect(0, 0, 320, 63)).clone()));
  ASSERT_FALSE(small);
  EXPECT_NE(small.error().message.find("320x63"), std::string::npos);
}

TEST(BallDetector, IsNotConfidentOfNoise) {
  cv::Mat noise(300, 400, CV_8U);
  cv::theRNG().state = 5;
  cv::randn(noise, 120, 30);
  const auto found = detect_ball(picture_of_mat(noise));
  if (!found) return;
  EXPECT_FALSE(found->is_confident()) << found->confidence;
  EXPECT_FALSE(found->reason.empty());
}

/// A ball in whose middle another one is seen, as a mirror shows round things of its room.
TEST(BallDetector, IsConfidentOfABallThatShowsAnother) {
  const optics::Outline outer{{400.2, 322.7}, 260, 260, 0};
  cv::Mat picture = painted_ball({800, 640}, outer);
  const cv::Rect middle(300, 220, 200, 200);
  const cv::Mat inner = painted_ball(middle.size(), {{99.6, 99.8}, 90, 90, 0});
  cv::Mat disc(middle.size(), CV_8U, cv::Scalar(0));
  cv::circle(disc, {100, 100}, 92, cv::Scalar(255), cv::FILLED);
  inner.copyTo(picture(middle), disc);
  const auto found = detect_ball(picture_of_mat(picture));
  ASSERT_TRUE(found) << found.error().message;
  EXPECT_NEAR(found->outline.centre.u, outer.centre.u, 0.01 * outer.rx);
  EXPECT_NEAR(found->outline.rx, outer.rx, 0.01 * outer.rx);
  EXPECT_TRUE(found->is_confident()) << found->confidence << ": " << found->reason;
}

TEST(BallDetector, TakesPicturesOfAnyShape) {
  for (const cv::Size size : {cv::Size(64, 64), cv::Size(65, 1500), cv::Size(1500, 65)}) {
    const cv::Mat grey = painted_ball(size, {{32, 32}, 20, 20, 0});
    const auto found = detect_ball(picture_of_mat(grey));
    if (found) {
      EXPECT_TRUE(optics::check_ellipse(found->outline));
    }
  }
}

}  // namespace
}  // namespace orbwatch::align
