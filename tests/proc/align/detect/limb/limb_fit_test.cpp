// SPDX-License-Identifier: Apache-2.0
#include "proc/align/detect/limb/limb_fit.h"

#include <gtest/gtest.h>

#include "proc/align/detect/limb/limb_score.h"
#include "proc/align/detect/limb/limb_strip.h"
#include "tests/proc/align/detect/painted_ball.h"

namespace orbwatch::align {
namespace {

using optics::Outline;

TEST(LimbFit, FindsTheLimbFromAround) {
  const cv::Mat picture = painted_ball(kSmallSize, kSmallLimb);
  for (const auto [du, dv, dr] : {std::array{2.5, -1.5, 1.0}, {-2.0, 2.0, -2.0}, {0.0, 0.0, 0.0}}) {
    Outline fit{{kSmallLimb.centre.u + du, kSmallLimb.centre.v + dv},
                kSmallLimb.rx + dr,
                kSmallLimb.rx + dr,
                0};
    for (const double reach : {6.0, 4.0, 3.0}) fit = fit_limb(picture, fit, reach).outline;
    EXPECT_NEAR(fit.centre.u, kSmallLimb.centre.u, 0.5);
    EXPECT_NEAR(fit.centre.v, kSmallLimb.centre.v, 0.5);
    EXPECT_NEAR((fit.rx + fit.ry) / 2, kSmallLimb.rx, 0.6);
    EXPECT_NEAR(fit.rx / fit.ry, 1, 0.01);
  }
}

TEST(LimbFit, FindsAHiddenPart) {
  cv::Mat picture = painted_ball(kSmallSize, kSmallLimb);
  cv::rectangle(picture, {185, 80}, {263, 130}, cv::Scalar(40), cv::FILLED);  // a mount
  Outline fit{{kSmallLimb.centre.u + 1.5, kSmallLimb.centre.v - 1}, 81.5, 81.5, 0};
  for (const double reach : {6.0, 4.0, 3.0}) fit = fit_limb(picture, fit, reach).outline;
  EXPECT_NEAR(fit.centre.u, kSmallLimb.centre.u, 0.8);
  EXPECT_NEAR(fit.centre.v, kSmallLimb.centre.v, 0.8);
  EXPECT_NEAR((fit.rx + fit.ry) / 2, kSmallLimb.rx, 0.8);
}

TEST(LimbFit, LeavesWhatIsTooSmallAsItIs) {
  const cv::Mat picture(100, 100, CV_8U, cv::Scalar(0));
  const Outline small{{50, 50}, 6, 5, 30};
  const Outline fit = fit_limb(picture, small, 4).outline;
  EXPECT_EQ(fit.centre.u, 50);
  EXPECT_EQ(fit.rx, 6);
  EXPECT_EQ(fit.ry, 5);
}

TEST(LimbStrip, UnrollsAnEllipseWithSlopesPerPixel) {
  // Brightness increases by 200 per pixel to the right. OpenCV samples between 32nds of a pixel.
  cv::Mat ramp(200, 300, CV_16U);
  for (int v = 0; v < ramp.rows; ++v) {
    for (int u = 0; u < ramp.cols; ++u)
      ramp.at<std::uint16_t>(v, u) = static_cast<std::uint16_t>(200 * u);
  }
  const Outline ellipse{{150, 100}, 60, 50, 25};
  const LimbStrip strip(ramp, ellipse, 5);
  EXPECT_EQ(strip.columns(), 2 * 5 * LimbStrip::kPerUnit + 1);
  EXPECT_EQ(strip.distance(strip.limb()), 0);
  EXPECT_EQ(strip.distance(strip.columns() - 1), 5);
  for (int ray = 0; ray < strip.rays(); ++ray) {
    const double own = 2 * std::numbers::pi * ray / strip.rays();
    const double normal = std::atan2(ellipse.rx * std::sin(own), ellipse.ry * std::cos(own)) +
                          optics::radians(ellipse.angle);
    const auto slope = strip.slope(ray, strip.limb());
    ASSERT_TRUE(slope);
    EXPECT_NEAR(slope->along, 200 * std::cos(normal), 6);
    EXPECT_NEAR(std::abs(slope->across), std::abs(200 * std::sin(normal)), 20);
  }
}

TEST(LimbStrip, KnowsNothingBeyondThePicture) {
  const cv::Mat picture = painted_ball(kSmallSize, kSmallLimb);
  const LimbStrip strip(picture, {{0, 100}, 60, 60, 0}, 5);
  EXPECT_TRUE(strip.slope(0, strip.limb()));
  EXPECT_FALSE(strip.slope(strip.rays() / 2, strip.limb()));
}

TEST(LimbScore, IsHighestAtTheLimb) {
  const cv::Mat picture = painted_ball(kSmallSize, kSmallLimb);
  const double right = near_drop(picture, kSmallLimb);
  EXPECT_GT(right, 0.3);
  EXPECT_GT(contour(picture, kSmallLimb), 0.5);
  for (const double share : {0.8, 0.9, 1.12, 1.25}) {
    const double r = share * kSmallLimb.rx;
    EXPECT_LT(near_drop(picture, {kSmallLimb.centre, r, r, 0}), right) << share;
  }
}

}  // namespace
}  // namespace orbwatch::align
