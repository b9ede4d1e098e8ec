// SPDX-License-Identifier: Apache-2.0
#include "app/pictures/thumbnail.h"

#include <gtest/gtest.h>

#include <cstdint>
#include <vector>

namespace orbwatch::app {
namespace {

/// Picture that is black on the left, white on the right, as Nv12 of full range.
std::vector<std::byte> half_white(int width, int height) {
  std::vector<std::byte> bytes(static_cast<std::size_t>(width) * height * 3 / 2, std::byte{128});
  for (int y = 0; y < height; ++y) {
    for (int x = 0; x < width; ++x) {
      bytes[static_cast<std::size_t>(y) * width + x] = std::byte(x < width / 2 ? 0 : 255);
    }
  }
  return bytes;
}

TEST(Thumbnail, OfALargePictureKeepsItsShapeAndColours) {
  const auto bytes = half_white(1920, 1080);
  const Picture large = Picture::contiguous(PixelFormat::Nv12, 1920, 1080, bytes.data(), 1920);
  Thumbnail thumbnail;
  const Picture small = thumbnail.of(large);
  EXPECT_EQ(small.format, PixelFormat::Rgb);
  EXPECT_EQ(small.width, 160);
  EXPECT_EQ(small.height, 90);
  const auto pixels = small.samples<std::uint8_t>();
  for (int channel = 0; channel < 3; ++channel) {
    EXPECT_LT(pixels.at(20, 45)[channel], 5);
    EXPECT_GT(pixels.at(140, 45)[channel], 250);
  }
}

TEST(Thumbnail, PixelsAreMeansOfThoseThatTheyStandFor) {
  std::vector<std::uint8_t> chequered(320 * 320);
  for (std::size_t n = 0; n < chequered.size(); ++n) {
    chequered[n] = (n % 320 + n / 320) % 2 == 0 ? 0 : 200;
  }
  Thumbnail thumbnail;
  const Picture small = thumbnail.of(
      picture_of(PixelFormat::Grey, ImageView<std::uint8_t>{chequered.data(), 320, 320, 1, 320}));
  EXPECT_EQ(small.format, PixelFormat::Grey);
  const auto pixels = small.samples<std::uint8_t>();
  for (int y = 0; y < 160; ++y) {
    for (int x = 0; x < 160; ++x) ASSERT_EQ(*pixels.at(x, y), 100);
  }
}

TEST(Thumbnail, OfASmallOrNarrowPictureHasASize) {
  Thumbnail thumbnail;
  std::vector<std::uint8_t> samples(4000, 7);
  const auto of = [&](int width, int height) {
    return thumbnail.of(picture_of(
        PixelFormat::Grey, ImageView<std::uint8_t>{samples.data(), width, height, 1, width}));
  };
  EXPECT_EQ(of(16, 9).width, 16);
  EXPECT_EQ(of(16, 9).height, 9);
  EXPECT_EQ(of(4000, 1).width, 160);
  EXPECT_EQ(of(4000, 1).height, 1);
  EXPECT_EQ(of(1, 4000).height, 160);
}

}  // namespace
}  // namespace orbwatch::app
