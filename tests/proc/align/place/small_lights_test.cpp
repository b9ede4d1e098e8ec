// SPDX-License-Identifier: Apache-2.0
#include "proc/align/place/small_lights.h"

#include <gtest/gtest.h>

#include <cmath>
#include <opencv2/imgproc.hpp>
#include <vector>

#include "tests/support/picture_of_mat.h"

namespace orbwatch::align {
namespace {

const optics::Outline kLitBall{{200, 150}, 120, 118, 10};

cv::Mat dark_room() { return {300, 400, CV_8U, cv::Scalar(40)}; }

cv::Mat with_light(cv::Mat picture, const optics::Vec2& at, double light, double sigma = 1.5) {
  for (int v = 0; v < picture.rows; ++v) {
    for (int u = 0; u < picture.cols; ++u) {
      const double square = std::pow(u - at.u, 2) + std::pow(v - at.v, 2);
      auto& pixel = picture.at<std::uint8_t>(v, u);
      pixel =
          cv::saturate_cast<std::uint8_t>(pixel + light * std::exp(-square / (2 * sigma * sigma)));
    }
  }
  return picture;
}

std::vector<SmallLight> lights_of(const std::vector<cv::Mat>& mats) {
  std::vector<Picture> pictures;
  for (const cv::Mat& mat : mats) pictures.push_back(tests::picture_of_mat(mat));
  const auto lights = small_lights(pictures, kLitBall);
  EXPECT_TRUE(lights) << (lights ? "" : lights.error().message);
  return lights.value_or(std::vector<SmallLight>{});
}

TEST(SmallLights, AreFoundToAFractionOfAPixel) {
  const auto lights = lights_of({with_light(dark_room(), {231.3, 120.7}, 180)});
  ASSERT_EQ(lights.size(), 1U);
  EXPECT_NEAR(lights[0].centre.u, 231.3, 0.05);
  EXPECT_NEAR(lights[0].centre.v, 120.7, 0.05);
}

TEST(SmallLights, AreNeitherSparksNorWideNorBesideTheBall) {
  cv::Mat still = with_light(dark_room(), {231.3, 120.7}, 120);
  cv::rectangle(still, {150, 150}, {190, 200}, cv::Scalar(200), cv::FILLED);  // a window
  still = with_light(still, {20, 20}, 200);
  std::vector<cv::Mat> pictures(8);
  for (std::size_t n = 0; n < pictures.size(); ++n) {
    pictures[n] = with_light(still.clone(), {180 + 6.0 * static_cast<double>(n), 90}, 200);
  }
  const auto lights = lights_of(pictures);
  ASSERT_EQ(lights.size(), 1U);
  EXPECT_NEAR(lights[0].centre.u, 231.3, 0.1);
}

TEST(SmallLights, WhereThereAreNoneIsAnError) {
  const cv::Mat dark = dark_room();
  EXPECT_FALSE(small_lights(std::vector{tests::picture_of_mat(dark)}, kLitBall));
  EXPECT_FALSE(small_lights({}, kLitBall));
  EXPECT_FALSE(small_lights(std::vector{tests::picture_of_mat(dark)}, {{2000, 150}, 120, 118, 0}));
}

TEST(SmallLights, TheOneThatMovedIsTheTools) {
  const cv::Mat lamps = with_light(dark_room(), {170, 180}, 200);
  const auto first = lights_of({with_light(lamps.clone(), {231, 120}, 120)});
  const auto second = lights_of({with_light(lamps.clone(), {240, 190}, 120)});
  const auto none = lights_of({lamps});
  const auto moved = moved_light(first, std::vector<std::vector<SmallLight>>{second}, kLitBall);
  ASSERT_TRUE(moved);
  EXPECT_NEAR(moved->u, 231, 0.1);
  EXPECT_FALSE(moved_light(none, std::vector{first, second}, kLitBall));
  EXPECT_NEAR(moved_light(none, {}, kLitBall)->u, 170, 0.1);
}

}  // namespace
}  // namespace orbwatch::align
