// SPDX-License-Identifier: Apache-2.0
#include "proc/remap/colour/luma.h"

#include <gtest/gtest.h>

#include <array>
#include <random>
#include <vector>

namespace orbwatch::remap {
namespace {

int luma_of(std::array<std::uint8_t, 3> rgb) { return luma(rgb.data()); }

TEST(Luma, WeighsTheColoursAsBt601Says) {
  EXPECT_EQ(luma_of({255, 255, 255}), 255);
  EXPECT_EQ(luma_of({255, 0, 0}), 76);
  EXPECT_EQ(luma_of({0, 255, 0}), 150);
  EXPECT_EQ(luma_of({0, 0, 255}), 29);
}

TEST(Luma, OfARowIsThatOfItsPixelsAndTouchesNoOthers) {
  std::mt19937 random(3);
  for (int width = 1; width <= 129; ++width) {
    std::vector<std::uint8_t> rgb(3 * static_cast<std::size_t>(width));
    std::vector<std::uint8_t> grey(static_cast<std::size_t>(width) + 1, 99);
    for (auto& sample : rgb) sample = static_cast<std::uint8_t>(random());
    luma(rgb.data(), grey.data(), width);
    for (int x = 0; x < width; ++x) ASSERT_EQ(grey[x], luma(&rgb[3 * x])) << x << " of " << width;
    ASSERT_EQ(grey.back(), 99);
  }
}

}  // namespace
}  // namespace orbwatch::remap
