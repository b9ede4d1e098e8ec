// SPDX-License-Identifier: Apache-2.0
#include "proc/remap/compiler/fitted_patch.h"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

namespace orbwatch::remap {
namespace {

/// Coefficients of the powers of x and y, in source pixels.
struct ThirdOrderMap {
  double constant, x, y, xy, xx, yy, xxy = 0, xyy = 0, xxx = 0, yyy = 0;

  double at(double px, double py) const {
    return constant + x * px + y * py + xy * px * py + xx * px * px + yy * py * py +
           xxy * px * px * py + xyy * px * py * py + xxx * px * px * px + yyy * py * py * py;
  }
};

Coordinate place_on(const ThirdOrderMap& u, const ThirdOrderMap& v, int x, int y) {
  const auto fixed = [](double c) {
    return static_cast<std::int32_t>(std::lround(c * (1 << kFractionBits)));
  };
  return {fixed(u.at(x, y)), fixed(v.at(x, y))};
}

CoordinateTile tile_on(const ThirdOrderMap& u, const ThirdOrderMap& v) {
  CoordinateTile tile;
  for (int y = 0; y < kTile; ++y) {
    for (int x = 0; x < kTile; ++x) tile[y][x] = place_on(u, v, x, y);
  }
  return tile;
}

/// The patch through the map's own nodes.
Patch patch_on(const ThirdOrderMap& u, const ThirdOrderMap& v) {
  Stencil nodes;
  for (int j = -1; j <= 2; ++j) {
    for (int i = -1; i <= 2; ++i) nodes.at(i, j) = place_on(u, v, i * kTile, j * kTile);
  }
  return Patch(nodes);
}

TEST(FittedPatch, IsTheMapItselfWherePatchesCanBe) {
  const ThirdOrderMap u{500, 1.2, -0.3, 0.001, 0.004, -0.003},
      v{700, 0.4, 0.9, -0.002, 0.001, 0.002};
  const CoordinateTile tile = tile_on(u, v);
  EXPECT_LT(largest_error(Patch(fitted_nodes(tile)), tile), 3) << "of 8192 in a pixel";
}

TEST(FittedPatch, ErrsLessThanThreeQuartersOfThatOfItsCorners) {
  std::mt19937 random(3);
  std::uniform_real_distribution<double> term(-1, 1);
  for (int i = 0; i < 100; ++i) {
    const auto map = [&] {
      return ThirdOrderMap{500,
                           term(random),
                           term(random),
                           term(random) / 500,
                           term(random) / 200,
                           term(random) / 200,
                           term(random) / 5000,
                           term(random) / 5000,
                           term(random) / 5000,
                           term(random) / 5000};
    };
    const ThirdOrderMap u = map(), v = map();
    const CoordinateTile tile = tile_on(u, v);
    EXPECT_LT(largest_error(Patch(fitted_nodes(tile)), tile),
              0.75 * largest_error(patch_on(u, v), tile))
        << i;
  }
}

TEST(FittedPatch, LargestErrorIsThatOfThePixelThatIsFurthestAway) {
  const ThirdOrderMap u{500, 1, 0, 0, 0, 0}, v{700, 0, 1, 0, 0, 0};
  CoordinateTile tile = tile_on(u, v);
  EXPECT_EQ(largest_error(patch_on(u, v), tile), 0);
  tile[15][2].u += 300;
  tile[15][2].v -= 400;
  EXPECT_EQ(largest_error(patch_on(u, v), tile), 500);
}

}  // namespace
}  // namespace orbwatch::remap
