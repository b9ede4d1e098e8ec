#include "proc/remap/colour_conversion.h"

#include <gtest/gtest.h>

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

TEST(Luma, WeighsTheColoursAsBt601Says) {
  EXPECT_EQ(luma(Rgb{255, 255, 255}.data()), 255);
  EXPECT_EQ(luma(Rgb{255, 0, 0}.data()), 76);
  EXPECT_EQ(luma(Rgb{0, 255, 0}.data()), 150);
  EXPECT_EQ(luma(Rgb{0, 0, 255}.data()), 29);
}

}  // namespace
}  // namespace orbwatch::remap
