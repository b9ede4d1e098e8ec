#include "proc/remap/colour/colour_map.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cstdint>
#include <numeric>
#include <utility>
#include <vector>

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
            ImageView<std::uint8_t>{rgb.data(), width, 1, 3, 3 * width}, {0, 1});
  std::vector<int> red;
  for (std::size_t i = 0; i < values.size(); ++i) red.push_back(rgb[3 * i]);
  EXPECT_EQ(red, (std::vector<int>{0, 0, 0, 1, 128, 255, 255, 255}));
  EXPECT_EQ(rgb[1], 255);
  EXPECT_EQ(rgb[2], 7);
}

TEST(ColourMap, ShowsEightBitPicturesAndOnlyTheRowsAskedFor) {
  const ColourMap map(ramp(), 0, 255);
  std::vector<std::uint8_t> values(20 * 40, 200), rgb(20 * 40 * 3, 1);
  map.apply(ImageView<const std::uint8_t>{values.data(), 20, 40, 1, 20},
            ImageView<std::uint8_t>{rgb.data(), 20, 40, 3, 60}, {1, 2});
  EXPECT_EQ(rgb[15 * 60], 1);
  EXPECT_EQ(rgb[16 * 60], 200);
  EXPECT_EQ(rgb[31 * 60], 200);
  EXPECT_EQ(rgb[32 * 60], 1);
}

TEST(ColourMap, EveryValueTakesTheEntryOfItsPlaceInTheRange) {
  const std::vector<std::pair<std::int64_t, std::int64_t>> ranges{
      {0, 65535}, {5000, 60000}, {1000, 1255}, {1000, 1256}, {-500, 70000}, {65000, 90000}, {3, 4}};
  constexpr double kRounding = 0.02;          // entries
  constexpr int kWidth = 1027, kHeight = 64;  // more than all values, and a last run that is cut
  std::vector<std::uint16_t> values(kWidth * kHeight);
  std::iota(values.begin(), values.end(), std::uint16_t{0});
  for (const auto& [low, high] : ranges) {
    const ColourMap map(ramp(), static_cast<double>(low), static_cast<double>(high));
    std::vector<std::uint8_t> rgb(values.size() * 3);
    map.apply(ImageView<const std::uint16_t>{values.data(), kWidth, kHeight, 1, kWidth},
              ImageView<std::uint8_t>{rgb.data(), kWidth, kHeight, 3, 3 * kWidth}, {0, 4});
    for (std::size_t i = 0; i < values.size(); ++i) {
      const auto above = static_cast<double>(std::clamp<std::int64_t>(values[i], low, high) - low);
      const double entry = 255 * above / static_cast<double>(high - low);
      ASSERT_NEAR(rgb[3 * i], entry, 0.5 + kRounding) << values[i] << " in " << low << ".." << high;
      ASSERT_EQ(rgb[3 * i + 1], 255 - rgb[3 * i]);
      ASSERT_EQ(rgb[3 * i + 2], 7);
    }
  }
}

TEST(ColourMap, BearsTheSmallestRange) {
  const ColourMap map(ramp(), 5, 5.1);
  const std::vector<std::uint16_t> values{5, 6};
  std::vector<std::uint8_t> rgb(6);
  map.apply(ImageView<const std::uint16_t>{values.data(), 2, 1, 1, 2},
            ImageView<std::uint8_t>{rgb.data(), 2, 1, 3, 6}, {0, 1});
  EXPECT_EQ(rgb[0], 0);
  EXPECT_EQ(rgb[3], 255);
}

}  // namespace
}  // namespace orbwatch::remap
