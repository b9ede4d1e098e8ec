// SPDX-License-Identifier: Apache-2.0
#include "hal/replay/png_check.h"

#include <gtest/gtest.h>

#include <opencv2/imgcodecs.hpp>

namespace orbwatch::hal {
namespace {

std::vector<std::byte> encoded() {
  cv::Mat image(11, 7, CV_16UC1);
  for (int i = 0; i < 77; ++i)
    image.at<std::uint16_t>(i / 7, i % 7) = static_cast<std::uint16_t>(i * 800);
  std::vector<unsigned char> png;
  EXPECT_TRUE(cv::imencode(".png", image, png));
  const auto* first = reinterpret_cast<const std::byte*>(png.data());
  return {first, first + png.size()};
}

TEST(PngCheck, ReadsTheSizeOfAWholeFile) {
  const auto size = check_png(encoded());
  ASSERT_TRUE(size) << size.error().message;
  EXPECT_EQ(size->width, 7U);
  EXPECT_EQ(size->height, 11U);
}

TEST(PngCheck, IgnoresWhatFollowsTheEnd) {
  auto png = encoded();
  png.resize(png.size() + 100);
  EXPECT_TRUE(check_png(png));
}

TEST(PngCheck, RefusesEveryTruncation) {
  const auto png = encoded();
  for (std::size_t length = 0; length < png.size(); ++length) {
    EXPECT_FALSE(check_png(std::span(png.data(), length))) << length << " of " << png.size();
  }
}

TEST(PngCheck, RefusesEveryFlippedBit) {
  const auto whole = encoded();
  for (std::size_t at = 0; at < whole.size(); ++at) {
    for (int bit = 0; bit < 8; ++bit) {
      auto png = whole;
      png[at] ^= std::byte{1} << bit;
      EXPECT_FALSE(check_png(png)) << "byte " << at << " bit " << bit;
    }
  }
}

}  // namespace
}  // namespace orbwatch::hal
