// SPDX-License-Identifier: Apache-2.0
#include "app/pictures/picture_scaler.h"

#include <gtest/gtest.h>

#include <cmath>
#include <cstdint>
#include <vector>

#include "proc/remap/remap.h"

namespace orbwatch::app {
namespace {

constexpr int kFullWidth = 320, kFullHeight = 160;

/// Samples of every plane, each `value(x, y)` at the middle of the pixels that it covers.
template <class Value>
std::vector<std::byte> painted(PixelFormat format, const Value& value) {
  const PixelFormatInfo& facts = info(format);
  std::vector<std::byte> bytes;
  for (std::size_t n = 0; n < facts.plane_count(); ++n) {
    const PlaneInfo& plane = facts.planes[n];
    const int step = 1 << plane.shift_x;
    for (int y = 0; y < kFullHeight >> plane.shift_y; ++y) {
      for (int x = 0; x < kFullWidth >> plane.shift_x; ++x) {
        const double level = value(step * (x + 0.5) - 0.5, step * (y + 0.5) - 0.5);
        bytes.insert(bytes.end(), static_cast<std::size_t>(plane.samples),
                     std::byte(std::lround(level)));
      }
    }
  }
  return bytes;
}

Picture picture_from(PixelFormat format, const std::vector<std::byte>& bytes) {
  return Picture::contiguous(format, kFullWidth, kFullHeight, bytes.data(),
                             row_bytes(format, kFullWidth));
}

/// A ramp is linear: each pixel must have its value in the middle of the pixels that it covers.
TEST(PictureScaler, KeepsPlacesInEveryPlaneAndSize) {
  const auto ramp = [](double x, double y) { return 10 + 0.5 * x + 0.5 * y; };
  PictureScaler scaler;
  for (const PixelFormat format :
       {PixelFormat::Grey, PixelFormat::Rgb, PixelFormat::Bgr, PixelFormat::I420}) {
    const auto bytes = painted(format, ramp);
    const PixelFormatInfo& facts = info(format);
    for (const int quarters : {1, 2, 3}) {
      const int width = kFullWidth * quarters / 4, height = kFullHeight * quarters / 4;
      const Picture small = scaler.scaled(picture_from(format, bytes), width, height);
      ASSERT_EQ(small.format, format);
      ASSERT_EQ(small.width, width);
      ASSERT_EQ(small.height, height);
      for (std::size_t n = 0; n < facts.plane_count(); ++n) {
        const PlaneInfo& plane = facts.planes[n];
        const double step = 4.0 / quarters * (1 << plane.shift_x);
        // At the edges the interpolation holds the last sample.
        for (int y = 1; y + 1 < height >> plane.shift_y; ++y) {
          for (int x = 1; x + 1 < width >> plane.shift_x; ++x) {
            const auto sample = static_cast<int>(
                small.planes[n].data[y * small.planes[n].stride + x * plane.samples]);
            ASSERT_NEAR(sample, ramp(step * (x + 0.5) - 0.5, step * (y + 0.5) - 0.5), 1)
                << info(format).name << " plane " << n << ", " << quarters << "/4, " << x << ", "
                << y;
          }
        }
      }
    }
  }
}

TEST(PictureScaler, MeansOfPixelsLeaveNoPattern) {
  const auto bytes = painted(
      PixelFormat::Grey, [](double x, double y) { return std::lround(x + y) % 2 == 0 ? 0 : 200; });
  PictureScaler scaler;
  for (const int quarters : {1, 2}) {
    const Picture small = scaler.scaled(picture_from(PixelFormat::Grey, bytes),
                                        kFullWidth * quarters / 4, kFullHeight * quarters / 4);
    for (int y = 0; y < small.height; ++y) {
      for (int x = 0; x < small.width; ++x) {
        ASSERT_EQ(static_cast<int>(small.planes[0].data[y * small.planes[0].stride + x]), 100);
      }
    }
  }
}

TEST(PictureScaler, KeepsTheColourSpaceAndSizesOfOnePixel) {
  const auto bytes = painted(PixelFormat::I420, [](double, double) { return 128; });
  Picture picture = picture_from(PixelFormat::I420, bytes);
  picture.colour_space = remap::kJfif;
  PictureScaler scaler;
  EXPECT_EQ(scaler.scaled(picture, 160, 80).colour_space.range, remap::kJfif.range);
  const Picture grey = picture_from(PixelFormat::Grey, bytes);
  EXPECT_EQ(scaler.scaled(grey, 1, 1).width, 1);
  EXPECT_EQ(scaler.scaled(grey, kFullWidth, kFullHeight).height, kFullHeight);
}

}  // namespace
}  // namespace orbwatch::app
