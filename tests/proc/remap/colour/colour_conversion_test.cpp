// SPDX-License-Identifier: Apache-2.0
#include "proc/remap/colour/colour_conversion.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>

namespace orbwatch::remap {
namespace {

using Rgb = std::array<std::uint8_t, 3>;

Rgb convert(ColourSpace space, int y, int u, int v) {
  Rgb rgb{};
  YuvToRgb convert(space);
  convert(y, u, v, rgb.data());
  return rgb;
}

TEST(YuvToRgb, MapsTheCornersOfEachSpace) {
  const ColourSpace limited{ColourMatrix::Bt601, ColourRange::Limited};
  const ColourSpace full{ColourMatrix::Bt601, ColourRange::Full};
  const ColourSpace hd{ColourMatrix::Bt709, ColourRange::Limited};
  EXPECT_EQ(convert(limited, 16, 128, 128), (Rgb{0, 0, 0}));
  EXPECT_EQ(convert(limited, 235, 128, 128), (Rgb{255, 255, 255}));
  EXPECT_EQ(convert(full, 0, 128, 128), (Rgb{0, 0, 0}));
  EXPECT_EQ(convert(full, 255, 128, 128), (Rgb{255, 255, 255}));
  EXPECT_EQ(convert(limited, 81, 90, 240), (Rgb{254, 0, 0}));  // 601 red, rounded to 8 bit
  EXPECT_EQ(convert(hd, 63, 102, 240), (Rgb{255, 1, 0}));      // 709 red
}

TEST(YuvToRgb, InvertsTheForwardTransform) {
  for (const ColourMatrix matrix : {ColourMatrix::Bt601, ColourMatrix::Bt709}) {
    const double kr = matrix == ColourMatrix::Bt601 ? 0.299 : 0.2126;
    const double kb = matrix == ColourMatrix::Bt601 ? 0.114 : 0.0722;
    for (int r = 0; r < 256; r += 15) {
      for (int g = 0; g < 256; g += 15) {
        for (int b = 0; b < 256; b += 15) {
          const double y = kr * r + (1 - kr - kb) * g + kb * b;
          const Rgb back = convert({matrix, ColourRange::Full}, static_cast<int>(std::lround(y)),
                                   static_cast<int>(std::lround(128 + (b - y) / (2 - 2 * kb))),
                                   static_cast<int>(std::lround(128 + (r - y) / (2 - 2 * kr))));
          EXPECT_NEAR(back[0], r, 2);
          EXPECT_NEAR(back[1], g, 2);
          EXPECT_NEAR(back[2], b, 2);
        }
      }
    }
  }
}

/// The values of BT.601 or BT.709, not rounded.
std::array<double, 3> exact(ColourSpace space, int y, int u, int v) {
  const double kr = space.matrix == ColourMatrix::Bt601 ? 0.299 : 0.2126;
  const double kb = space.matrix == ColourMatrix::Bt601 ? 0.114 : 0.0722;
  const bool full = space.range == ColourRange::Full;
  const double luminance = full ? y : (y - 16) * 255.0 / 219;
  const double cb = (u - 128) * (full ? 1 : 255.0 / 224);
  const double cr = (v - 128) * (full ? 1 : 255.0 / 224);
  const double red = luminance + 2 * (1 - kr) * cr, blue = luminance + 2 * (1 - kb) * cb;
  return {red, (luminance - kr * red - kb * blue) / (1 - kr - kb), blue};
}

/// Calls `check(space, u, v)` for pairs of chroma with both ends of the range among them.
template <class Check>
void for_each_chroma(const Check& check) {
  for (const ColourMatrix matrix : {ColourMatrix::Bt601, ColourMatrix::Bt709}) {
    for (const ColourRange range : {ColourRange::Limited, ColourRange::Full}) {
      for (int u = 0; u < 256; u += 15) {
        for (int v = 0; v < 256; v += 15) check(ColourSpace{matrix, range}, u, v);
      }
    }
  }
}

TEST(YuvToRgb, RoundsAndClipsWhatTheStandardsSay) {
  for_each_chroma([](ColourSpace space, int u, int v) {
    for (int y = 0; y < 256; ++y) {
      const Rgb found = convert(space, y, u, v);
      const std::array<double, 3> expected = exact(space, y, u, v);
      for (std::size_t k = 0; k < 3; ++k) {
        ASSERT_NEAR(found[k], std::clamp(expected[k], 0.0, 255.0), 0.53)
            << y << ' ' << u << ' ' << v << ", colour " << k;
      }
    }
  });
}

TEST(YuvToRgb, ConvertsARunAsItsPixels) {
  for_each_chroma([](ColourSpace space, int u, int v) {
    for (int first = 0; first < 256; first += static_cast<int>(kRun)) {
      SampleRun luminance{}, chroma{};
      for (std::size_t x = 0; x < kRun; ++x) {
        luminance[x] = static_cast<std::uint8_t>(first + static_cast<int>(x));
        // Each two pixels have another pair.
        const int shifted = (x % 2 == 0 ? u : v) + static_cast<int>(x / 2) * 37;
        chroma[x] = static_cast<std::uint8_t>(shifted);
      }
      const YuvToRgb conversion(space);
      const RgbRun run = conversion(luminance, conversion.shared(chroma));
      for (std::size_t x = 0; x < kRun; ++x) {
        const Rgb expected = convert(space, luminance[x], chroma[x & ~1U], chroma[x | 1U]);
        ASSERT_EQ((Rgb{run.red[x], run.green[x], run.blue[x]}), expected) << "pixel " << x;
      }
    }
  });
}

}  // namespace
}  // namespace orbwatch::remap
