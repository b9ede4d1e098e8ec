// SPDX-License-Identifier: Apache-2.0
#include "proc/remap/colour/yuv420.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <random>
#include <vector>

#include "proc/remap/colour/colour_conversion.h"
#include "proc/remap/colour/luma.h"
#include "tests/proc/remap/stored_picture.h"

namespace orbwatch::remap {
namespace {

using tests::StoredPicture;

/// A view of which one tile is written, and nothing beside it.
struct OneTileView {
  static constexpr int kSide = 48;

  OneTileView() : stored(PixelFormat::I420, kSide, kSide) {
    std::ranges::fill(stored.bytes, std::byte{77});
    stored.picture.colour_space = kJfif;
  }
  int luminance(int x, int y) const { return stored.sample(0, y, x); }
  int chroma(std::size_t plane, int x, int y) const { return stored.sample(plane, y, x); }
  void expect_untouched_beside(const TileArea& area) const {
    for (int y = 0; y < kSide; ++y) {
      for (int x = 0; x < kSide; ++x) {
        const bool inside =
            x >= area.x && x < area.x + area.columns && y >= area.y && y < area.y + area.rows;
        if (inside) continue;
        ASSERT_EQ(luminance(x, y), 77) << x << ", " << y;
        ASSERT_EQ(chroma(1, x / 2, y / 2), 77) << x << ", " << y;
        ASSERT_EQ(chroma(2, x / 2, y / 2), 77) << x << ", " << y;
      }
    }
  }

  StoredPicture stored;
};

const std::array kAreas{TileArea{16, 16, 16, 16}, TileArea{16, 32, 6, 10}, TileArea{0, 0, 2, 2}};

TEST(Yuv420, OfColoursIsThatOfJfif) {
  std::mt19937 random(5);
  for (const TileArea& area : kAreas) {
    std::vector<std::uint8_t> rgb(3 * kTile * kTile);
    for (auto& sample : rgb) {
      sample = static_cast<std::uint8_t>(random() % 3 == 0 ? 255 * (random() % 2) : random());
    }
    OneTileView view;
    write_yuv420({rgb.data(), kTile, kTile, 3, 3 * kTile}, view.stored.picture, area);
    for (int y = 0; y < area.rows; ++y) {
      for (int x = 0; x < area.columns; ++x) {
        ASSERT_EQ(view.luminance(area.x + x, area.y + y), luma(&rgb[3 * (kTile * y + x)]));
        std::array<double, 3> mean{};
        for (const int k : {0, 1, 2}) {
          for (const int i : {0, 1, kTile, kTile + 1}) {
            mean[k] += rgb[3 * (kTile * (y & ~1) + (x & ~1) + i) + k] / 4.0;
          }
        }
        const double grey = 0.299 * mean[0] + 0.587 * mean[1] + 0.114 * mean[2];
        const double u = std::min(255.0, 128 + (mean[2] - grey) / 1.772);
        const double v = std::min(255.0, 128 + (mean[0] - grey) / 1.402);
        ASSERT_NEAR(view.chroma(1, (area.x + x) / 2, (area.y + y) / 2), u, 0.51);
        ASSERT_NEAR(view.chroma(2, (area.x + x) / 2, (area.y + y) / 2), v, 0.51);
      }
    }
    view.expect_untouched_beside(area);
  }
}

class Yuv420Source : public testing::TestWithParam<PixelFormat> {};

TEST_P(Yuv420Source, KeepsItsSamplesAndTakesTheFullRange) {
  const PixelFormat format = GetParam();
  std::mt19937 random(6);
  for (const ColourRange range : {ColourRange::Limited, ColourRange::Full}) {
    const ColourSpace colour_space{ColourMatrix::Bt601, range};
    ASSERT_TRUE(is_yuv420(format, colour_space));
    for (const TileArea& area : kAreas) {
      SampledTile tile;
      for (auto& plane : tile.planes) {
        for (auto& sample : plane) sample = static_cast<std::uint8_t>(random());
      }
      OneTileView view;
      write_yuv420(tile, format, colour_space, view.stored.picture, area);
      const bool full = range == ColourRange::Full;
      const auto chroma_at = [&](std::size_t n, int x, int y) -> double {
        if (format == PixelFormat::I420) return tile.planes[1 + n][kTile * y + x];
        const std::size_t first = format == PixelFormat::Nv21 ? 1 : 0;
        return tile.planes[1][2 * (kTile * y + x) + (n ^ first)];
      };
      const auto stretched = [full](double sample, double black, double steps) {
        return full ? sample : std::clamp((sample - black) * 255 / steps, -128.0, 255.0);
      };
      for (int y = 0; y < area.rows; ++y) {
        for (int x = 0; x < area.columns; ++x) {
          const double grey = std::max(0.0, stretched(tile.planes[0][kTile * y + x], 16, 219));
          ASSERT_NEAR(view.luminance(area.x + x, area.y + y), grey, 0.51);
          for (const std::size_t n : {0U, 1U}) {
            const double sample = chroma_at(n, x / 2, y / 2);
            const double expected =
                full ? sample : std::clamp((sample - 128) * 255 / 224 + 128, 0.0, 255.0);
            ASSERT_NEAR(view.chroma(1 + n, (area.x + x) / 2, (area.y + y) / 2), expected, 0.51);
          }
        }
      }
      view.expect_untouched_beside(area);
    }
  }
}

INSTANTIATE_TEST_SUITE_P(Formats, Yuv420Source,
                         testing::Values(PixelFormat::Nv12, PixelFormat::Nv21, PixelFormat::I420),
                         [](const auto& test) {
                           return std::string(orbwatch::info(test.param).name);
                         });

TEST(Yuv420, IsNotWhatOtherSourcesHave) {
  EXPECT_FALSE(is_yuv420(PixelFormat::Nv12, {ColourMatrix::Bt709, ColourRange::Limited}));
  EXPECT_FALSE(is_yuv420(PixelFormat::Yuyv, kJfif)) << "its chroma lies elsewhere";
  EXPECT_FALSE(is_yuv420(PixelFormat::Rgb, kJfif));
}

}  // namespace
}  // namespace orbwatch::remap
