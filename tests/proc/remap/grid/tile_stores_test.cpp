// SPDX-License-Identifier: Apache-2.0
#include "proc/remap/grid/tile_stores.h"

#include <gtest/gtest.h>

#include <cmath>
#include <random>
#include <vector>

#include "proc/remap/compiler/tolerance.h"

namespace orbwatch::remap {
namespace {

CoordinateTile random_coordinates(std::mt19937& random, double span) {
  std::uniform_real_distribution<double> place(0, span);
  CoordinateTile tile;
  for (CoordinateRow& row : tile) {
    for (Coordinate& c : row) {
      c = {static_cast<std::int32_t>((1000 + place(random)) * kOnePixel),
           static_cast<std::int32_t>((-40 + place(random)) * kOnePixel)};
    }
  }
  return tile;
}

TEST(PackedTile, LosesAtMostATinyShareOfAPixel) {
  std::mt19937 random(1);
  for (const double span : {0.001, 1.0, 7.9, 8.1, 30.0, 100.0, 255.0}) {
    CoordinateTile tile = random_coordinates(random, span);
    tile[3][5] = {kBlind, 0};
    tile[15][15] = {kOutside, 0};
    const auto packed = PackedTile::pack(tile);
    ASSERT_TRUE(packed) << span;
    for (int y = 0; y < kTile; ++y) {
      const CoordinateRow row = packed->row(y);
      for (int x = 0; x < kTile; ++x) {
        if (!is_defined(tile[y][x])) {
          EXPECT_EQ(row[x].u, tile[y][x].u);
          continue;
        }
        const double limit = span < 8 ? 0 : 1.0 / 512;
        EXPECT_LE(std::abs(row[x].u - tile[y][x].u) / kOnePixel, limit);
        EXPECT_LE(std::abs(row[x].v - tile[y][x].v) / kOnePixel, limit);
      }
    }
  }
}

TEST(PackedTile, RefusesWhatItCouldNotKeep) {
  std::mt19937 random(2);
  CoordinateTile tile = random_coordinates(random, 1);
  tile[0][0].u += 300 << kFractionBits;
  EXPECT_FALSE(PackedTile::pack(tile));
  tile[0][0] = {-(1 << 30), 1 << 30};
  EXPECT_FALSE(PackedTile::pack(tile));
}

TEST(PackedTile, KeepsMarkersAlone) {
  CoordinateTile tile;
  for (CoordinateRow& row : tile) row.fill({kBlind, 0});
  tile[7].fill({kOutside, 0});
  const auto packed = PackedTile::pack(tile);
  ASSERT_TRUE(packed);
  EXPECT_EQ(packed->row(6)[0].u, kBlind);
  EXPECT_EQ(packed->row(7)[15].u, kOutside);
}

TEST(PixelTiles, KeepNarrowAndWideTiles) {
  std::mt19937 random(3);
  PixelTiles tiles;
  std::vector<CoordinateTile> given;
  std::vector<std::uint32_t> indices;
  for (const double span : {7.0, 1000.0, 3.0, 2000.0}) {
    given.push_back(random_coordinates(random, span));
    given.back()[2][9] = {kOutside, 0};
    indices.push_back(tiles.add(given.back()));
  }
  for (std::size_t n = 0; n < given.size(); ++n) {
    const CoordinateTile pixels = tiles.pixels(indices[n]);
    for (int y = 0; y < kTile; ++y) {
      const CoordinateRow row = tiles.row(indices[n], y);
      for (int x = 0; x < kTile; ++x) {
        EXPECT_EQ(row[x].u, given[n][y][x].u);
        EXPECT_EQ(row[x].v, given[n][y][x].v);
        EXPECT_EQ(pixels[y][x].u, given[n][y][x].u);
        EXPECT_EQ(pixels[y][x].v, given[n][y][x].v);
      }
    }
  }
  EXPECT_LT(tiles.bytes(), 3.2 * sizeof(CoordinateTile)) << "two of them in half of the memory";
}

/// A smooth map with terms up to the second degree, which patches represent exactly except for
/// rounding.
Coordinate bent(double x, double y) {
  return {
      static_cast<std::int32_t>(std::lround((100 + 0.7 * x - 0.2 * y + 0.003 * x * x) * kOnePixel)),
      static_cast<std::int32_t>(std::lround((50 + 0.1 * x + 0.9 * y - 0.002 * y * y) * kOnePixel))};
}

void expect_near(const Coordinate& a, const Coordinate& b, double tolerance = 2) {
  EXPECT_NEAR(a.u, b.u, tolerance);
  EXPECT_NEAR(a.v, b.v, tolerance);
}

TEST(SplitTile, TakesEachPixelFromItsSide) {
  constexpr double kPointError = 2 + kOnePixel / 700;  // see PointAxis
  SplitTile tile{};
  for (int j = -1; j <= 2; ++j) {
    for (int i = -1; i <= 2; ++i) {
      tile.sides[0].at(i, j) = bent(i * kTile, j * kTile);
      tile.sides[1].at(i, j) = bent(i * kTile + 500, j * kTile + 300);
    }
  }
  for (int y = 0; y < kTile; ++y) tile.second[y] = static_cast<std::uint16_t>(0xFFFF << y);
  tile.second[7] = 0;
  const CoordinateTile pixels = tile.pixels();
  for (int y = 0; y < kTile; ++y) {
    const CoordinateRow row = tile.row(y);
    for (int x = 0; x < kTile; ++x) {
      expect_near(row[x], y != 7 && x >= y ? bent(x + 500, y + 300) : bent(x, y), kPointError);
      EXPECT_EQ(pixels[y][x].u, row[x].u);
      EXPECT_EQ(pixels[y][x].v, row[x].v);
    }
  }
}

template <int Cell>
void expect_fine_tile_follows() {
  FineTile<Cell> tile;
  for (int j = 0; j < tile.kNodes; ++j) {
    for (int i = 0; i < tile.kNodes; ++i) {
      tile.nodes[j][i] = bent((i - 1) * Cell, (j - 1) * Cell);
    }
  }
  for (int y = 0; y < kTile; ++y) {
    const CoordinateRow row = tile.row(y);
    for (int x = 0; x < kTile; ++x) {
      expect_near(row[x], bent(x, y));
      EXPECT_EQ(tile.pixels()[y][x].u, row[x].u);
      EXPECT_EQ(tile.pixels()[y][x].v, row[x].v);
    }
  }
}

TEST(FineTile, FollowsAMapThroughItsNodes) {
  expect_fine_tile_follows<8>();
  expect_fine_tile_follows<4>();
}

/// A map that also has terms of third order, and those of the fourth that a Coons patch has.
Coordinate curved(double x, double y) {
  const double u = x * x * x - 2 * x * x * y + 3 * x * y * y - y * y * y;
  const double v = 0.05 * (x * x * x * y - 2 * x * y * y * y);
  const Coordinate smooth = bent(x, y);
  return {smooth.u + static_cast<std::int32_t>(std::lround(u)),
          smooth.v + static_cast<std::int32_t>(std::lround(v))};
}

TEST(CurvedTile, HasTheNodesOfAMapOfThirdOrder) {
  Stencil nodes;
  for (int j = -1; j <= 2; ++j) {
    for (int i = -1; i <= 2; ++i) nodes.at(i, j) = curved(i * kTile, j * kTile);
  }
  // Nodes that are not used may be anything.
  for (const int i : {-1, 2}) nodes.at(i, -1) = nodes.at(i, 2) = {kBlind, 0};
  const FineTile<8> tile = curved_tile(nodes);
  for (int j = 0; j < tile.kNodes; ++j) {
    for (int i = 0; i < tile.kNodes; ++i) {
      expect_near(tile.nodes[j][i], curved((i - 1) * 8, (j - 1) * 8));
    }
  }
}

TEST(CurvedTile, RefinesFineNodesToo) {
  FineTile<8> fine;
  for (int j = 0; j < fine.kNodes; ++j) {
    for (int i = 0; i < fine.kNodes; ++i) fine.nodes[j][i] = curved((i - 1) * 8, (j - 1) * 8);
  }
  for (const int i : {0, 4}) fine.nodes[0][i] = fine.nodes[4][i] = {kBlind, 0};
  const FineTile<4> tile = curved_tile(fine);
  for (int j = 0; j < tile.kNodes; ++j) {
    for (int i = 0; i < tile.kNodes; ++i) {
      expect_near(tile.nodes[j][i], curved((i - 1) * 4, (j - 1) * 4));
    }
  }
}

}  // namespace
}  // namespace orbwatch::remap
