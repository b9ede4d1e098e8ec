// SPDX-License-Identifier: Apache-2.0
#include "proc/remap/kernel/kernel_map.h"

#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <optional>

#include "tests/proc/remap/kernel/random_patch.h"

namespace orbwatch::remap {
namespace {

using tests::RandomPatch;
using tests::Steepness;

constexpr int kPixelQ13 = 1 << kFractionBits;

std::optional<BlockMap> map_of(const Patch& patch, int add_u, int add_v, int rows = kTile) {
  BlockMap map;
  const bool fits = map.fit(patch, kTile, rows, BlockMap::rounding(add_u, add_v));
  return fits ? std::optional(map) : std::nullopt;
}

/// A pixel of a block by the comments on WindowWalk and LaneShape, without 16 bit lanes.
struct LanePlace {
  std::int64_t window;  ///< source pixels
  std::int64_t lane;    ///< distance from there, Q13

  std::int64_t coordinate() const { return window * kPixelQ13 + lane; }
};

struct Pixel {
  int block_x, block_y, i, j;
};

/// Axis 0 or 1, u or v, which is the `member` of each AxisPair.
template <auto member>
LanePlace place_of(const BlockMap& map, int axis, std::uint16_t offset, const Pixel& p) {
  const LaneShape& shape = map.lanes;
  const auto pairs = [](std::int64_t n) { return n * (n - 1) / 2; };
  const WindowWalk& walk = map.windows;
  const std::int64_t corner = walk.value[axis] + p.block_x * walk.step_x[axis] +
                              p.block_y * walk.step_y[axis] + pairs(p.block_x) * walk.xx[axis] +
                              p.block_x * p.block_y * walk.xy[axis] +
                              pairs(p.block_y) * walk.yy[axis];
  const bool is_row = axis == 1;
  const int shift = is_row ? kFractionBits - kRowFractionBits : 0;
  const auto rounded = [shift](std::int64_t value) { return (value + (1 << shift) / 2) >> shift; };
  const std::int64_t xy = shape.xy.*member;
  const std::int64_t along_x = (p.i * shape.twice_xx.*member + p.j * xy + 4) >> 3;
  const std::int64_t along_y = (p.i * xy + p.j * shape.twice_yy.*member + 4) >> 3;
  const std::int64_t start = p.i * shape.slope_x.*member + p.j * shape.slope_y.*member +
                             ((p.i * along_x + p.j * along_y + 4) >> 3) + offset;
  const std::int64_t fraction = corner & 0xffffffff;
  const std::int64_t lane = (fraction >> (32 - kFractionBits + shift)) + rounded(start) +
                            p.block_x * rounded(along_x) + p.block_y * rounded(along_y);
  return {corner >> 32, is_row ? (lane - kRowCentre) * (1 << shift) : lane};
}

void for_all_pixels(const BlockMap& map,
                    const std::function<void(Pixel, LanePlace, LanePlace)>& see) {
  using Lane = AxisPair<std::int16_t>;
  for (Pixel p{}; p.block_y < map.blocks_y; ++p.block_y) {
    for (p.block_x = 0; p.block_x < map.blocks_x; ++p.block_x) {
      for (p.j = 0; p.j < kBlock; ++p.j) {
        for (p.i = 0; p.i < kBlock; ++p.i) {
          see(p, place_of<&Lane::u>(map, 0, map.lanes.offset.u, p),
              place_of<&Lane::v>(map, 1, map.lanes.offset.v, p));
        }
      }
    }
  }
}

/// Every pixel's neighbours are in the part of the window that the map says it needs.
void expect_in_windows(const BlockMap& map) {
  ASSERT_TRUE(map.is_within(kWindow, kWindow));
  int columns = kWindow, rows = kWindow;
  while (map.is_within(columns - 1, kWindow)) --columns;
  while (map.is_within(kWindow, rows - 1)) --rows;
  for_all_pixels(map, [=](Pixel, LanePlace u, LanePlace v) {
    ASSERT_GE(u.lane, 0);
    ASSERT_LT(u.lane, (columns - 1) * kPixelQ13);
    ASSERT_GE(v.lane, 0);
    ASSERT_LT(v.lane, (rows - 1) * kPixelQ13);
  });
}

TEST(BlockMap, FollowsThePatch) {
  constexpr double kRounding = kPixelQ13 / 240.0;
  std::mt19937 random(1);
  for (int round = 0; round < 300; ++round) {
    const Steepness most{round % 2 ? 0.9 : 0.3, round % 3 ? 0.008 : 0};
    const Patch patch = RandomPatch(random, most).patch();
    const auto map = map_of(patch, 32, 11, round % 2 ? kTile : 2 * kTile);
    if (!map) continue;
    for_all_pixels(*map, [&](Pixel p, LanePlace u, LanePlace v) {
      const Coordinate there = patch.at(kBlock * p.block_x + p.i, kBlock * p.block_y + p.j);
      ASSERT_NEAR(static_cast<double>(u.coordinate()), there.u + 32.0, kRounding);
      ASSERT_NEAR(static_cast<double>(v.coordinate()), there.v + 11.0, kRounding);
    });
  }
}

/// The axis moved so that block (x, y) begins exactly where a window does, or one step before,
/// where its window ends. `begin`: origin of that axis's windows, Q32.
Quadratic moved(Quadratic axis, std::int64_t begin, int x, int y, bool before) {
  constexpr std::int64_t kPixel = std::int64_t{1} << 24;
  x *= kBlock;
  y *= kBlock;
  const std::int64_t corner =
      (begin >> 8) + x * axis.x + y * axis.y + x * y * axis.xy + x * x * axis.xx + y * y * axis.yy;
  axis.value -= (corner & (kPixel - 1)) + (before ? 1 : 0);
  return axis;
}

TEST(BlockMap, StaysInItsWindowsUpToTheLimit) {
  std::mt19937 random(2);
  for (int round = 0; round < 300; ++round) {
    const double curvature = round % 5 == 0 ? 0 : round % 5 == 1 ? 0.3 : 0.02;
    const int blocks_y = round % 2 ? 4 : 8, rows = blocks_y * kBlock;
    const int columns = round % 3 ? kWindow : 5, rows_needed = round % 7 ? kWindow : 6;
    const Patch patch =
        RandomPatch(random, {1, curvature}).steepest(4, blocks_y, columns, rows_needed);
    for (int block = 0; block < 8 * blocks_y; ++block) {
      const auto axis = [=](const Quadratic& q, std::int64_t begin) {
        return moved(q, begin, block % 4, block / 4 % blocks_y, block >= 4 * blocks_y);
      };
      const WindowWalk windows = map_of(patch, 0, 0, rows)->windows;
      const Patch at_edge(axis(patch.u(), windows.value[0]), axis(patch.v(), windows.value[1]));
      const auto map = map_of(at_edge, 0, 0, rows);
      ASSERT_TRUE(map);
      expect_in_windows(*map);
    }
  }
}

// All terms add up: slopes of one sign in the corner that curvature makes steepest.
TEST(BlockMap, StaysInItsWindowsAtTheCorners) {
  constexpr std::int64_t kPixel = std::int64_t{1} << 24;
  for (int signs = 0; signs < 32; ++signs) {
    const auto sign = [signs](int bit) { return signs >> bit & 1 ? -1 : 1; };
    for (const std::int64_t curvature : {0, 1, 1000, 100000, 200000, 229376}) {
      std::int64_t fits = 0;
      for (std::int64_t slope = 0; slope < kPixel; slope += kPixel / 100 + 3) {
        const Quadratic axis{kPixel - 1,          sign(0) * slope,     sign(1) * slope,
                             sign(2) * curvature, sign(3) * curvature, sign(4) * curvature};
        const auto map = map_of(Patch(axis, axis), 0, 0);
        if (!map) continue;
        fits = slope;
        expect_in_windows(*map);
      }
      if (curvature <= 1000) {
        EXPECT_GT(fits, kPixel * 9 / 10);
      }
    }
  }
}

TEST(BlockMap, TakesWhatFitsAndRefusesWhatDoesNot) {
  const auto make = [](double along_x, double along_y, double curvature) {
    const auto q24 = [](double pixels) { return static_cast<std::int64_t>(pixels * (1 << 24)); };
    const Quadratic steep{0, q24(along_x), q24(along_y), 0, q24(curvature), 0};
    const Quadratic flat{0, 0, q24(1), 0, 0, 0};
    const auto one = map_of(Patch(steep, flat), 32, 0);
    const auto other = map_of(Patch(flat, steep), 32, 0);
    EXPECT_EQ(one.has_value(), other.has_value());
    return one.has_value();
  };
  // Three steps of both slopes may span six pixels.
  EXPECT_TRUE(make(1.98, 0, 0));
  EXPECT_TRUE(make(0, -1.98, 0));
  EXPECT_TRUE(make(0.99, -0.99, 0));
  EXPECT_FALSE(make(2.01, 0, 0));
  EXPECT_FALSE(make(-1.01, 1.01, 0));
  EXPECT_TRUE(make(1.4, 0, 0.013));
  EXPECT_FALSE(make(1.6, 0, 0.0141));
  EXPECT_FALSE(make(0, 0, 0.015));
  // Slopes range up to the steepest patch that exists.
  for (const double steep : {3, 8, 16}) {
    EXPECT_FALSE(make(steep, 0, 0));
    EXPECT_FALSE(make(-steep, steep, 0));
    EXPECT_FALSE(make(0, 0, steep / 16));
  }
}

}  // namespace
}  // namespace orbwatch::remap
