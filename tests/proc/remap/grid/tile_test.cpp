// SPDX-License-Identifier: Apache-2.0
#include "proc/remap/grid/tile.h"

#include <gtest/gtest.h>

#include <random>

namespace orbwatch::remap {
namespace {

Tile random_tile(std::mt19937& random, double own) {
  std::uniform_real_distribution<double> share(0, 1);
  const auto any = [&](int count) { return static_cast<int>(share(random) * count); };
  Tile tile{static_cast<TileKind>(any(3)), any(2) == 1,
            static_cast<std::uint8_t>(any(kMaxLevel + 1))};
  if (share(random) < own) {
    tile.kind = static_cast<TileKind>(3 + any(6));
    if (has_store(tile.kind)) tile.index = random();
  }
  return tile;
}

TEST(TileTable, GivesBackWhatItWasGiven) {
  std::mt19937 random(7);
  for (const double own : {0.0, 0.002, 0.3, 1.0}) {
    std::vector<Tile> tiles;
    TileTable table(1000);
    for (std::size_t i = 0; i < 1000; ++i) {
      tiles.push_back(random_tile(random, own));
      if (!has_store(tiles.back().kind)) tiles.back().index = static_cast<std::uint32_t>(i);
      table.set(i, tiles.back());
    }
    for (std::size_t i = 0; i < tiles.size(); ++i) {
      const Tile tile = table[i];
      EXPECT_EQ(tile.kind, tiles[i].kind);
      EXPECT_EQ(tile.interior, tiles[i].interior);
      EXPECT_EQ(tile.level, tiles[i].level);
      EXPECT_EQ(tile.index, tiles[i].index) << own << ' ' << i;
    }
  }
}

TEST(TileTable, TakesAByteForAPlainTile) {
  TileTable table(1000);
  for (std::size_t i = 0; i < 1000; ++i) table.set(i, {TileKind::Patch, true, 2});
  EXPECT_EQ(table.bytes(), 1000U);
}

}  // namespace
}  // namespace orbwatch::remap
