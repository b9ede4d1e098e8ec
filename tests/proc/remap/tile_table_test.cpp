#include "proc/remap/tile_table.h"

#include <gtest/gtest.h>

#include <random>

namespace orbwatch::remap {
namespace {

Tile random_tile(std::mt19937& random, double own) {
  std::uniform_real_distribution<double> share(0, 1);
  const auto any = [&](int count) { return static_cast<int>(share(random) * count); };
  Tile tile{static_cast<TileClass>(any(4)), TileStore::Grid, any(2) == 1,
            static_cast<std::uint8_t>(any(kMaxLevel + 1)), 0};
  if (share(random) < own) {
    tile.store = static_cast<TileStore>(1 + any(7));
    if (!is_on_grid(tile.store)) tile.index = random();
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
      if (is_on_grid(tiles.back().store)) tiles.back().index = static_cast<std::uint32_t>(i);
      table.set(i, tiles.back());
    }
    for (std::size_t i = 0; i < tiles.size(); ++i) {
      const Tile tile = table[i];
      EXPECT_EQ(tile.kind, tiles[i].kind);
      EXPECT_EQ(tile.store, tiles[i].store);
      EXPECT_EQ(tile.interior, tiles[i].interior);
      EXPECT_EQ(tile.level, tiles[i].level);
      EXPECT_EQ(tile.index, tiles[i].index) << own << ' ' << i;
    }
  }
}

TEST(TileTable, TakesAByteForAPlainTile) {
  TileTable table(1000);
  for (std::size_t i = 0; i < 1000; ++i) table.set(i, {TileClass::Patch, {}, true, 2, 0});
  EXPECT_EQ(table.bytes(), 1000U);
}

}  // namespace
}  // namespace orbwatch::remap
