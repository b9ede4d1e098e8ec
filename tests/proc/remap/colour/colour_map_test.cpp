// SPDX-License-Identifier: Apache-2.0
#include "proc/remap/colour/colour_map.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cstdint>
#include <numeric>
#include <random>
#include <string>
#include <utility>
#include <vector>

#include "proc/remap/colour/chroma.h"
#include "proc/remap/colour/luma.h"

namespace orbwatch::remap {
namespace {

ColourMap::Table ramp() {
  ColourMap::Table table;
  for (std::size_t i = 0; i < table.size(); ++i) {
    table[i] = {static_cast<std::uint8_t>(i), static_cast<std::uint8_t>(255 - i), 7};
  }
  return table;
}

TEST(ColourMap, SpreadsItsEntriesOverTheRange) {
  const ColourMap map(ramp(), 1000, 1510);
  const std::vector<std::uint16_t> values{0, 999, 1000, 1002, 1255, 1510, 1511, 65535};
  std::vector<std::uint8_t> rgb(values.size() * 3);
  const int width = static_cast<int>(values.size());
  map.apply(ImageView<const std::uint16_t>{values.data(), width, 1, 1, width},
            ImageView<std::uint8_t>{rgb.data(), width, 1, 3, 3 * width}, scalar_kernel());
  std::vector<int> red;
  for (std::size_t i = 0; i < values.size(); ++i) red.push_back(rgb[3 * i]);
  EXPECT_EQ(red, (std::vector<int>{0, 0, 0, 1, 128, 255, 255, 255}));
  EXPECT_EQ(rgb[1], 255);
  EXPECT_EQ(rgb[2], 7);
}

TEST(ColourMap, ShowsEightBitPicturesInEitherOrderAndAsLuma) {
  const ColourMap map(ramp(), 0, 255);
  constexpr int kRows = 5;
  for (const int width : {kTile, 7}) {
    const std::vector<std::uint8_t> values(width * kRows, 200);
    const ImageView<const std::uint8_t> view{values.data(), width, kRows, 1, width};
    std::vector<std::uint8_t> rgb(3 * values.size()), bgr(rgb), grey(values.size());
    for (const Kernel* kernel : kernels()) {
      map.apply(view, {rgb.data(), width, kRows, 3, 3 * width}, *kernel);
      map.apply(view, {bgr.data(), width, kRows, 3, 3 * width}, *kernel, PixelFormat::Bgr);
      map.apply(view, {grey.data(), width, kRows, 1, width}, *kernel);
      for (std::size_t i = 0; i < values.size(); ++i) {
        ASSERT_EQ(rgb[3 * i], 200);
        ASSERT_EQ(bgr[3 * i + 2], 200);
        ASSERT_EQ(rgb[3 * i + 2], 7);
        ASSERT_EQ(bgr[3 * i], 7);
        ASSERT_NEAR(grey[i], 0.299 * 200 + 0.587 * 55 + 0.114 * 7, 1);
      }
    }
  }
}

TEST(ColourMap, EveryValueTakesTheEntryOfItsPlaceInTheRange) {
  const std::vector<std::pair<std::int64_t, std::int64_t>> ranges{
      {0, 65535}, {5000, 60000}, {1000, 1255}, {1000, 1256}, {-500, 70000}, {65000, 90000}, {3, 4}};
  constexpr double kRounding = 0.02;  // entries
  constexpr int kValues = 65536, kRows = kValues / kTile;
  std::vector<std::uint16_t> values(kValues);
  std::iota(values.begin(), values.end(), std::uint16_t{0});
  for (const auto& [low, high] : ranges) {
    for (const Kernel* kernel : kernels()) {
      const ColourMap map(ramp(), static_cast<double>(low), static_cast<double>(high));
      std::vector<std::uint8_t> rgb(values.size() * 3);
      for (int y = 0; y < kRows; y += kTile) {
        // Runs as wide as a tile use another code path than narrower ones.
        const int width = y % (2 * kTile) == 0 ? kTile : 5;
        for (int x = 0; x < kTile; x += width) {
          const int columns = std::min(width, kTile - x), at = y * kTile + x;
          map.apply(ImageView<const std::uint16_t>{&values[at], columns, kTile, 1, kTile},
                    {&rgb[3 * at], columns, kTile, 3, 3 * kTile}, *kernel);
        }
      }
      for (std::size_t i = 0; i < values.size(); ++i) {
        const auto above =
            static_cast<double>(std::clamp<std::int64_t>(values[i], low, high) - low);
        const double entry = 255 * above / static_cast<double>(high - low);
        ASSERT_NEAR(rgb[3 * i], entry, 0.5 + kRounding)
            << values[i] << " in " << low << ".." << high;
        ASSERT_EQ(rgb[3 * i + 1], 255 - rgb[3 * i]);
        ASSERT_EQ(rgb[3 * i + 2], 7);
      }
    }
  }
}

/// A picture of 4:2:0 by the colours of an Rgb one: luma, then the chroma of each two by two
/// pixels' colours, rounded, and its mean.
int expected_chroma(const ChromaWeights& weights, const std::uint8_t* rgb, int stride) {
  int sum = 2;
  for (const int at : {0, 3, stride, stride + 3}) {
    sum += chroma_of(weights, 4 * rgb[at], 4 * rgb[at + 1], 4 * rgb[at + 2]);
  }
  return sum / 4;
}

/// Compares the I420 picture of values with their Rgb one.
template <class T>
void expect_colours_in_yuv420(const ColourMap& map, const ImageView<const T>& values,
                              const Kernel& kernel) {
  std::array<std::uint8_t, 3 * kTile * kTile> rgb{};
  map.apply(values, {rgb.data(), values.width, values.height, 3, 3 * kTile}, kernel);
  Yuv420Tile tile;
  map.apply(values, tile.planes(), kernel);
  const auto [luma_plane, u, v] = tile.planes();
  for (int y = 0; y < values.height; ++y) {
    for (int x = 0; x < values.width; ++x) {
      const std::uint8_t* const colour = &rgb[3 * (kTile * y + x)];
      ASSERT_EQ(luma_plane.row(y)[x], luma(colour)) << x << ", " << y;
      if ((x | y) % 2 != 0) continue;
      ASSERT_EQ(u.row(y / 2)[x / 2], expected_chroma(kWeightsOfU, colour, 3 * kTile))
          << x << ", " << y;
      ASSERT_EQ(v.row(y / 2)[x / 2], expected_chroma(kWeightsOfV, colour, 3 * kTile))
          << x << ", " << y;
    }
  }
}

TEST(ColourMap, ShowsTheSameColoursInYuv420) {
  std::mt19937 random(9);
  std::array<std::uint8_t, kTile * kTile> bytes;
  std::array<std::uint16_t, kTile * kTile> words;
  for (auto& value : bytes) value = static_cast<std::uint8_t>(random());
  for (auto& value : words) value = static_cast<std::uint16_t>(random());
  for (const Kernel* kernel : kernels()) {
    for (const auto& [width, height] : {std::pair{kTile, kTile}, {kTile, 6}, {10, kTile}, {2, 2}}) {
      SCOPED_TRACE(std::string(kernel->name) + " " + std::to_string(width));
      expect_colours_in_yuv420(ColourMap(ramp(), 0, 255),
                               ImageView<const std::uint8_t>{bytes.data(), width, height, 1, kTile},
                               *kernel);
      for (const double low : {5000, -500}) {
        expect_colours_in_yuv420(
            ColourMap(ramp(), low, 60000),
            ImageView<const std::uint16_t>{words.data(), width, height, 1, kTile}, *kernel);
      }
    }
  }
}

TEST(ColourMap, BearsTheSmallestRange) {
  const ColourMap map(ramp(), 5, 5.1);
  const std::vector<std::uint16_t> values{5, 6};
  std::vector<std::uint8_t> rgb(6);
  map.apply(ImageView<const std::uint16_t>{values.data(), 2, 1, 1, 2},
            ImageView<std::uint8_t>{rgb.data(), 2, 1, 3, 6}, scalar_kernel());
  EXPECT_EQ(rgb[0], 0);
  EXPECT_EQ(rgb[3], 255);
}

}  // namespace
}  // namespace orbwatch::remap
