// SPDX-License-Identifier: Apache-2.0
#include "proc/remap/grid/source_area.h"

#include <gtest/gtest.h>

#include <array>

namespace orbwatch::remap {
namespace {

TEST(SourceArea, UnitedAreTheSmallestThatHoldsBoth) {
  EXPECT_EQ(united({1, 2, 3, 4}, {2, 0, 9, 3}), (SourceArea{1, 0, 9, 4}));
  EXPECT_EQ(united({}, {2, 0, 9, 3}), (SourceArea{2, 0, 9, 3}));
  EXPECT_EQ(united({2, 0, 9, 3}, {5, 5, 5, 9}), (SourceArea{2, 0, 9, 3}));
  EXPECT_TRUE(common({0, 0, 3, 3}, {3, 0, 5, 5}).is_empty());
}

TEST(SourceArea, TheRestOfAnAreaIsEachPixelThatThePartLacksOnce) {
  constexpr int kSide = 7;
  const SourceArea whole{1, 1, 6, 5};
  for (const SourceArea& part : {SourceArea{}, SourceArea{3, 2, 5, 4}, SourceArea{1, 1, 4, 3},
                                 SourceArea{2, 1, 6, 5}, whole}) {
    std::array<std::array<int, kSide>, kSide> times{};
    for_each_rest(whole, part, [&](const SourceArea& area) {
      for (int y = area.top; y < area.bottom; ++y) {
        for (int x = area.left; x < area.right; ++x) ++times[y][x];
      }
    });
    const auto holds = [](const SourceArea& area, int x, int y) {
      return x >= area.left && x < area.right && y >= area.top && y < area.bottom;
    };
    for (int y = 0; y < kSide; ++y) {
      for (int x = 0; x < kSide; ++x) {
        EXPECT_EQ(times[y][x], holds(whole, x, y) && !holds(part, x, y)) << x << ", " << y;
      }
    }
  }
}

}  // namespace
}  // namespace orbwatch::remap
