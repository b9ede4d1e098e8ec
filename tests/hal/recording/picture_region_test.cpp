// SPDX-License-Identifier: Apache-2.0
#include "hal/recording/picture_region.h"

#include <gtest/gtest.h>

#include <limits>
#include <string>

#include "tests/hal/recording/random_picture.h"

/// Parts of pictures, and their places in the whole ones.
namespace orbwatch::hal::recording {
namespace {

using tests::contains;
using tests::RandomPicture;
using tests::samples_at;

std::string place_refusal(const CameraInfo& message) {
  const auto place = place_of(message);
  return place ? "accepted" : place.error().message;
}

CameraInfo info_with(RegionOfInterest roi) {
  CameraInfo message;
  message.width = 640;
  message.height = 512;
  message.roi = roi;
  return message;
}

TEST(PictureRegion, APartReturnsToItsPlaceAndTheRestIsBlack) {
  std::mt19937 random(38);
  for (int k = 0; k < 200; ++k) {
    for (const PixelFormatInfo& facts : kPixelFormats) {
      const auto sides = tests::random_sides(random, facts.format);
      const RandomPicture source(random, facts.format, sides.width, sides.height, 6);
      const auto region = tests::random_region(random, facts.format, sides.width, sides.height);
      const PicturePlace place{sides.width, sides.height, region};
      RandomPicture target(random, facts.format, sides.width, sides.height, 2);
      blacken(target.picture);
      const auto black = samples_at(target.picture, 0, 0);
      const Picture part = part_of(Picture(source.picture), region);
      const auto fits = check_fit(part.format, part.width, part.height, place, facts.format);
      ASSERT_TRUE(fits) << facts.name << ": " << fits.error().message;
      copy_pixels(part, part_of(target.picture, region));
      for (int y = 0; y < sides.height; ++y) {
        for (int x = 0; x < sides.width; ++x) {
          const auto expected = contains(region, x, y) ? samples_at(source.picture, x, y) : black;
          ASSERT_EQ(samples_at(target.picture, x, y), expected)
              << facts.name << " at " << x << "," << y;
        }
      }
    }
  }
}

TEST(PictureRegion, BlackHasNeutralChroma) {
  std::mt19937 random(39);
  const std::byte zero{0}, neutral{128};
  const std::vector<std::pair<PixelFormat, std::vector<std::byte>>> blacks{
      {PixelFormat::Yuyv, {zero, neutral, zero, neutral}},
      {PixelFormat::Uyvy, {neutral, zero, neutral, zero}},
      {PixelFormat::Nv12, {zero, neutral, neutral}},
      {PixelFormat::I420, {zero, neutral, neutral}},
      {PixelFormat::Rgb, {zero, zero, zero}},
      {PixelFormat::Y16, {zero, zero}}};
  for (const auto& [format, black] : blacks) {
    const RandomPicture picture(random, format, 6, 4, 2);
    blacken(picture.picture);
    EXPECT_EQ(samples_at(picture.picture, 5, 3), black) << info(format).name;
  }
}

TEST(PictureRegion, IsWidenedWherePixelsShareChroma) {
  const PictureRegion odd{3, 5, 4, 7};
  EXPECT_EQ(widened(odd, PixelFormat::Y16), odd);
  EXPECT_EQ(widened(odd, PixelFormat::Rgb), odd);
  EXPECT_EQ(widened(odd, PixelFormat::Yuyv), (PictureRegion{2, 5, 6, 7}));
  EXPECT_EQ(widened(odd, PixelFormat::Nv12), (PictureRegion{2, 4, 6, 8}));
  EXPECT_EQ(widened(odd, PixelFormat::I420), (PictureRegion{2, 4, 6, 8}));
}

TEST(PictureRegion, ReturnsFromCameraInfo) {
  std::mt19937 random(40);
  for (int k = 0; k < 1000; ++k) {
    const int width = tests::between(random, 1, kMaxSide), height = tests::between(random, 1, 900);
    const PicturePlace place{width, height,
                             tests::random_region(random, PixelFormat::Grey, width, height)};
    EXPECT_EQ(place_of(camera_info_of(place, {})), place);
  }
}

TEST(PictureRegion, OfZerosIsTheWholePicture) {
  const PicturePlace whole{640, 512, {0, 0, 640, 512}};
  EXPECT_EQ(place_of(info_with({})), whole);
  EXPECT_EQ(camera_info_of(whole, {}).roi, RegionOfInterest{});
}

TEST(PictureRegion, PlacesOutsideOfThePictureAreRefused) {
  constexpr auto kMost = std::numeric_limits<std::uint32_t>::max();
  EXPECT_EQ(place_refusal(info_with({.x_offset = 320, .y_offset = 0, .height = 512, .width = 320})),
            "accepted");
  EXPECT_EQ(place_refusal(info_with({.x_offset = 321, .y_offset = 0, .height = 512, .width = 320})),
            "camera_info: region of 320x512 at 321,0; it must be inside of the picture of 640x512");
  for (const RegionOfInterest roi :
       {RegionOfInterest{.x_offset = kMost, .y_offset = 0, .height = 1, .width = 2},
        RegionOfInterest{.x_offset = 0, .y_offset = kMost, .height = 2, .width = 1},
        RegionOfInterest{.x_offset = 0, .y_offset = 0, .height = kMost, .width = 1},
        RegionOfInterest{.x_offset = 0, .y_offset = 0, .height = 1, .width = kMost},
        RegionOfInterest{.x_offset = 1, .y_offset = 1, .height = 0, .width = 0},
        RegionOfInterest{.x_offset = 0, .y_offset = 0, .height = 1, .width = 0}}) {
    EXPECT_NE(place_refusal(info_with(roi)).find("it must be inside of the picture of 640x512"),
              std::string::npos);
  }
  CameraInfo message;
  EXPECT_EQ(place_refusal(message), "camera_info: picture of 0x0; its sides must be 1 to 16384");
  message = info_with({});
  message.binning_x = 2;
  EXPECT_EQ(place_refusal(message),
            "camera_info: binning of 2x0; only whole pixels (0 or 1) are read");
}

TEST(PictureRegion, PicturesThatDoNotFitTheirPlaceAreRefused) {
  constexpr PixelFormat part = PixelFormat::Nv12, grey = PixelFormat::Grey;
  const auto refusal_at = [](const PictureRegion& region, PixelFormat format) {
    const auto fits = check_fit(format, 4, 4, {16, 12, region}, PixelFormat::Nv12);
    return fits ? "accepted" : fits.error().message;
  };
  EXPECT_EQ(refusal_at({2, 2, 4, 4}, part), "accepted");
  EXPECT_EQ(refusal_at({2, 2, 6, 4}, part), "picture of 4x4; camera_info has a region of 6x4");
  EXPECT_EQ(refusal_at({3, 2, 4, 4}, part),
            "region at 3,2 of 4x4 in pixel format nv12; its edges must be even where pixels share "
            "chroma");
  EXPECT_EQ(refusal_at({2, 2, 4, 4}, grey),
            "pixel format grey; the camera's first picture has nv12");
}

}  // namespace
}  // namespace orbwatch::hal::recording
