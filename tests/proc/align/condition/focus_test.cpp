// SPDX-License-Identifier: Apache-2.0
#include "proc/align/condition/focus.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>
#include <opencv2/imgproc.hpp>
#include <string>

#include "tests/support/picture_of_mat.h"

namespace orbwatch::align {
namespace {

using optics::Outline;
using tests::picture_of_mat;

const Outline kBlurredLimb{{150.3, 148.8}, 130, 130, 0};

/// A far room of grey patches, reflected by plain vectors, before a bright wall; 4x4 samples to
/// a pixel.
cv::Mat patched_ball() {
  const auto patch = [](double x, double y) -> double {
    const auto cell = static_cast<std::uint32_t>(static_cast<int>(std::floor(x)) * 31 +
                                                 static_cast<int>(std::floor(y)) * 17 + 1000);
    return 40.0 + (cell * 2654435761U >> 24) * 0.7;
  };
  const auto light = [&](double u, double v) {
    const double x = (u - kBlurredLimb.centre.u) / kBlurredLimb.rx;
    const double y = (v - kBlurredLimb.centre.v) / kBlurredLimb.ry;
    if (x * x + y * y >= 1) return 230.0;
    // Towards the camera; the camera's ray is (0, 0, -1).
    const double z = std::sqrt(1 - x * x - y * y);
    const optics::Vec3 r{2 * z * x, 2 * z * y, 2 * z * z - 1};
    return 0.8 * patch(6 * std::atan2(r.x, r.z), 6 * std::asin(std::clamp(r.y, -1.0, 1.0)));
  };
  cv::Mat picture(300, 300, CV_32F);
  for (int v = 0; v < picture.rows; ++v) {
    for (int u = 0; u < picture.cols; ++u) {
      double sum = 0;
      for (int i = 0; i < 16; ++i) sum += light(u + (i % 4 - 1.5) / 4, v + (i / 4 - 1.5) / 4);
      picture.at<float>(v, u) = static_cast<float>(sum / 16);
    }
  }
  return picture;
}

const cv::Mat& sharp_picture() {
  static const cv::Mat picture = patched_ball();
  return picture;
}

/// The sharp picture times `exposure`, then blurred as a whole.
cv::Mat blurred(double sigma, double exposure = 1) {
  cv::Mat picture;
  picture = sharp_picture() * exposure;
  cv::GaussianBlur(picture, picture, {}, sigma);
  cv::Mat noise(picture.size(), CV_32F);
  cv::RNG random(5);
  random.fill(noise, cv::RNG::NORMAL, 0, 1.5);
  picture += noise;
  picture.convertTo(picture, CV_8U);
  return picture;
}

TEST(Focus, IsTheReflectionsBlurAtAnyExposure) {
  for (const double sigma : {0.6, 1.2, 2.5}) {
    for (const double exposure : {1.0, 0.35}) {
      const auto focus = measure_focus(picture_of_mat(blurred(sigma, exposure)), kBlurredLimb);
      ASSERT_TRUE(focus);
      ASSERT_TRUE(focus->reflection) << focus->reflection.error().message;
      // The pixel's aperture adds blur.
      EXPECT_NEAR(focus->reflection->sigma, std::hypot(sigma, 0.29), std::max(0.15, 0.15 * sigma));
      EXPECT_GE(focus->reflection->edges, 10);
      EXPECT_LT(focus->reflection->error, 0.15);
    }
  }
}

TEST(Focus, OfTheReflectionAlone) {
  const cv::Mat pixels = blurred(1.2);
  const auto alone = reflection_blur(picture_of_mat(pixels), kBlurredLimb);
  const auto focus = measure_focus(picture_of_mat(pixels), kBlurredLimb);
  ASSERT_TRUE(alone && focus && focus->reflection);
  EXPECT_EQ(alone->sigma, focus->reflection->sigma);
  EXPECT_EQ(alone->edges, focus->reflection->edges);
  const cv::Mat dark(300, 300, CV_8U, cv::Scalar(0));
  EXPECT_FALSE(reflection_blur(picture_of_mat(dark), kBlurredLimb));
  EXPECT_FALSE(reflection_blur(picture_of_mat(pixels), {{1500, 150}, 130, 130, 0}));
}

TEST(Focus, OfAWideBlurIsTheSameFromASmallerPicture) {
  // A ball as large as one in focus that was enlarged eight times.
  constexpr double kScale = 8;
  const double centre_u = (kBlurredLimb.centre.u + 0.5) * kScale - 0.5;
  const double centre_v = (kBlurredLimb.centre.v + 0.5) * kScale - 0.5;
  const Outline limb{{centre_u, centre_v}, kBlurredLimb.rx * kScale, kBlurredLimb.ry * kScale, 0};
  for (const double sigma : {0.6, 1.2, 2.5}) {
    cv::Mat large;
    cv::resize(blurred(sigma), large, {}, kScale, kScale, cv::INTER_LINEAR);
    const auto whole = reflection_blur(picture_of_mat(large), limb);
    const auto rough = reflection_blur(picture_of_mat(large), limb, 4);
    ASSERT_TRUE(whole && rough) << sigma;
    EXPECT_GT(whole->sigma, 4) << sigma;
    EXPECT_NEAR(rough->sigma, whole->sigma, 0.05 * whole->sigma) << sigma;
  }
}

TEST(Focus, LooksAtNoEdgesThatAreOverexposed) {
  // The brightest patches are cut off: their edges are too sharp.
  const cv::Mat bright = blurred(1.2, 1.5);
  const auto blur = reflection_blur(picture_of_mat(bright), kBlurredLimb);
  ASSERT_TRUE(blur) << blur.error().message;
  EXPECT_NEAR(blur->sigma, std::hypot(1.2, 0.29), 0.15);
}

TEST(Focus, SaysThatTheBallIsSharpAndItsReflectionIsNot) {
  const cv::Mat wide = blurred(2.5);
  cv::Mat picture = blurred(0.6);
  cv::Mat inner(picture.size(), CV_8U, cv::Scalar(0));
  cv::circle(inner, {150, 149}, 115, cv::Scalar(255), cv::FILLED);
  wide.copyTo(picture, inner);
  const auto focus = measure_focus(picture_of_mat(picture), kBlurredLimb);
  ASSERT_TRUE(focus);
  ASSERT_TRUE(focus->focused_on_ball()) << focus->focused_on_ball().error().message;
  EXPECT_GT(*focus->focused_on_ball(), 1.5);
  const auto even = measure_focus(picture_of_mat(blurred(0.6)), kBlurredLimb);
  ASSERT_TRUE(even && even->focused_on_ball());
  EXPECT_LT(*even->focused_on_ball(), 0.6);
}

TEST(Focus, OfSixteenBit) {
  cv::Mat picture;
  blurred(1.2).convertTo(picture, CV_16U, 20, 7000);
  const auto focus = measure_focus(picture_of_mat(picture), kBlurredLimb);
  ASSERT_TRUE(focus && focus->reflection);
  EXPECT_NEAR(focus->reflection->sigma, 1.25, 0.18);
}

TEST(Focus, IsNotMeasuredWithoutLightOrEdges) {
  const auto reason = [](const cv::Mat& picture) -> std::string {
    const auto focus = measure_focus(picture_of_mat(picture), kBlurredLimb);
    if (!focus || focus->reflection) return "measured";
    return focus->reflection.error().message;
  };
  EXPECT_NE(reason(blurred(0.6, 0.01)).find("dark"), std::string::npos);
  EXPECT_NE(reason(cv::Mat(300, 300, CV_8U, cv::Scalar(255))).find("overexposed"),
            std::string::npos);
  EXPECT_NE(reason(cv::Mat(300, 300, CV_8U, cv::Scalar(100))).find("edges"), std::string::npos);
}

TEST(Focus, RefusesOutlinesThatAreNone) {
  const cv::Mat pixels = blurred(0.6);
  const Picture picture = picture_of_mat(pixels);
  EXPECT_FALSE(measure_focus(picture, {{150, 150}, 0, 130, 0}));
  EXPECT_FALSE(measure_focus(picture, {{1500, 150}, 130, 130, 0}));
  EXPECT_FALSE(
      measure_focus(picture, {{std::numeric_limits<double>::quiet_NaN(), 150}, 130, 130, 0}));
  const auto huge = measure_focus(picture, {{150, 150}, 1e12, 1e12, 0});
  EXPECT_FALSE(huge && huge->reflection);
}

}  // namespace
}  // namespace orbwatch::align
