// SPDX-License-Identifier: Apache-2.0
#include "proc/align/detect/picture/pyramid.h"

#include <gtest/gtest.h>

namespace orbwatch::align {
namespace {

cv::Mat ramp(int width, int height) {
  cv::Mat picture(height, width, CV_16U);
  for (int v = 0; v < height; ++v) {
    for (int u = 0; u < width; ++u) {
      picture.at<std::uint16_t>(v, u) = static_cast<std::uint16_t>(8 * u + 4 * v);
    }
  }
  return picture;
}

TEST(Pyramid, HalvesDownToItsSmallest) {
  EXPECT_EQ(Pyramid(ramp(63, 25)).size(), 1U);
  EXPECT_EQ(Pyramid(ramp(64, 25)).size(), 2U);
  const Pyramid pyramid(ramp(1201, 900));
  ASSERT_EQ(pyramid.size(), 6U);
  EXPECT_EQ(pyramid.level(3).size(), cv::Size(150, 112));
  EXPECT_EQ(pyramid.level(5).size(), cv::Size(37, 28));
}

TEST(Pyramid, APlaceHasTheSameBrightnessAtEveryLevel) {
  const Pyramid pyramid(ramp(1024, 800));
  for (std::size_t n = 1; n < pyramid.size(); ++n) {
    const auto [u, v] = Pyramid::between({{15, 20}, 1, 1, 0}, n, 0).centre;
    EXPECT_NEAR(pyramid.level(n).at<std::uint16_t>(20, 15), 8 * u + 4 * v, 1) << n;
  }
}

TEST(Pyramid, OutlinesGoAndComeBack) {
  const optics::Outline outline{{123.25, 77.5}, 40, 38, 12};
  const optics::Outline back = Pyramid::between(Pyramid::between(outline, 0, 3), 3, 0);
  EXPECT_DOUBLE_EQ(back.centre.u, outline.centre.u);
  EXPECT_DOUBLE_EQ(back.centre.v, outline.centre.v);
  EXPECT_DOUBLE_EQ(back.rx, 40);
  EXPECT_DOUBLE_EQ(back.ry, 38);
  EXPECT_DOUBLE_EQ(back.angle, 12);
}

TEST(Pyramid, ALevelShowsALimbAtAboutTheWantedRadius) {
  const Pyramid pyramid(ramp(2048, 1600));
  const auto level = [&](double radius) {
    return pyramid.level_for({{900, 800}, radius, radius, 0}, 90);
  };
  EXPECT_EQ(level(50), 0U);
  EXPECT_EQ(level(135), 0U);
  EXPECT_EQ(level(136), 1U);
  EXPECT_EQ(level(700), 3U);
  EXPECT_EQ(level(1e6), pyramid.size() - 1);
}

}  // namespace
}  // namespace orbwatch::align
