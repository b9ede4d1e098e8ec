#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "proc/remap/tile.h"

namespace orbwatch::remap {

/// A grid's tiles in a byte each. The few with a store of their own find their place there by
/// counting those before them; a table without any pays nothing for it. Reentrant to read.
class TileTable {
 public:
  TileTable() = default;
  explicit TileTable(std::size_t count) : records_(count) {}

  Tile operator[](std::size_t number) const {
    const Record& record = records_[number];
    return {record.kind, record.store, record.interior, record.level,
            is_on_grid(record.store) ? static_cast<std::uint32_t>(number) : index(number)};
  }

  /// Tiles with a store of their own come in rising order.
  void set(std::size_t number, const Tile& tile) {
    records_[number] = Record{tile.kind, tile.store, tile.interior, tile.level};
    if (!is_on_grid(tile.store)) set_index(number, tile.index);
  }

  std::size_t bytes() const;

 private:
  struct Record {
    TileClass kind : 2 = TileClass::Blind;
    TileStore store : 3 = TileStore::Grid;
    bool interior : 1 = false;
    std::uint8_t level : 2 = 0;
  };
  static_assert(sizeof(Record) == 1 && kMaxLevel < 4);

  /// 64 tiles: which of them have a store of their own, and how many have one before them.
  struct Word {
    std::uint64_t own = 0;
    std::uint32_t before = 0;
  };

  std::uint32_t index(std::size_t number) const;
  void set_index(std::size_t number, std::uint32_t index);

  std::vector<Record> records_;
  std::vector<Word> words_;             ///< none when no tile has a store of its own
  std::vector<std::uint32_t> indices_;  ///< of those tiles, in their stores
};

}  // namespace orbwatch::remap
