// SPDX-License-Identifier: Apache-2.0
#include "hal/mosaic/demosaic.h"

#include <gtest/gtest.h>

#include <array>
#include <random>
#include <string_view>
#include <vector>

namespace orbwatch::hal {
namespace {

constexpr int kMosaicWidth = 38;
constexpr int kMosaicHeight = 22;

struct Order {
  Mosaic mosaic;
  std::string_view letters;  ///< colours of the pixels (0,0), (1,0), (0,1), (1,1)
};

class DemosaicOrder : public testing::TestWithParam<Order> {};

/// Reference by the definition of bilinear: the mean of the nearest samples of a colour, which are
/// the pixel itself, two or four beside it, or four at its corners.
TEST_P(DemosaicOrder, IsBilinear) {
  std::mt19937 random(3);
  std::vector<std::uint8_t> samples(std::size_t{kMosaicWidth} * kMosaicHeight);
  for (auto& sample : samples) sample = static_cast<std::uint8_t>(random());
  const ImageView<const std::uint8_t> mosaic{samples.data(), kMosaicWidth, kMosaicHeight, 1,
                                             kMosaicWidth};
  constexpr std::ptrdiff_t kStride = 3 * kMosaicWidth + 5;
  std::vector<std::uint8_t> pixels(std::size_t{kStride} * kMosaicHeight, 0xee);
  const ImageView<std::uint8_t> bgr{pixels.data(), kMosaicWidth, kMosaicHeight, 3, kStride};
  const auto done = demosaic(GetParam().mosaic, mosaic, bgr);
  ASSERT_TRUE(done) << done.error().message;

  const auto letter = [](int x, int y) {
    return GetParam().letters[static_cast<std::size_t>(x % 2 + 2 * (y % 2))];
  };
  for (int y = 1; y < kMosaicHeight - 1; ++y) {
    EXPECT_EQ(bgr.row(y)[3 * kMosaicWidth], 0xee) << "wrote behind row " << y;
    for (int x = 1; x < kMosaicWidth - 1; ++x) {
      for (int channel = 0; channel < 3; ++channel) {
        int nearest = 9;
        int sum = 0;
        int count = 0;
        for (int dy = -1; dy <= 1; ++dy) {
          for (int dx = -1; dx <= 1; ++dx) {
            const int distance = dx * dx + dy * dy;
            if (letter(x + dx, y + dy) != "bgr"[channel] || distance > nearest) continue;
            if (distance < nearest) sum = count = 0;
            nearest = distance;
            sum += *mosaic.at(x + dx, y + dy);
            ++count;
          }
        }
        ASSERT_NEAR(bgr.at(x, y)[channel], static_cast<double>(sum) / count, 0.75)
            << x << ", " << y << ", channel " << channel;
      }
    }
  }
}
INSTANTIATE_TEST_SUITE_P(All, DemosaicOrder,
                         testing::Values(Order{Mosaic::Rggb, "rggb"}, Order{Mosaic::Grbg, "grbg"},
                                         Order{Mosaic::Gbrg, "gbrg"}, Order{Mosaic::Bggr, "bggr"}),
                         [](const auto& order) { return std::string(order.param.letters); });

TEST(Demosaic, RefusesWhatIsNoMosaic) {
  std::array<std::uint8_t, 192> memory{};
  const ImageView<const std::uint8_t> samples{memory.data(), 8, 8, 1, 8};
  std::array<std::uint8_t, 192> colours{};
  const ImageView<std::uint8_t> bgr{colours.data(), 8, 8, 3, 24};
  EXPECT_TRUE(demosaic(Mosaic::Rggb, samples, bgr));
  EXPECT_FALSE(demosaic(Mosaic::None, samples, bgr));
  EXPECT_FALSE(demosaic(Mosaic::Rggb, samples, {colours.data(), 8, 6, 3, 24}));
  EXPECT_FALSE(demosaic(Mosaic::Rggb, {memory.data(), 2, 8, 1, 8}, {colours.data(), 2, 8, 3, 24}));
}

}  // namespace
}  // namespace orbwatch::hal
