// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <bit>
#include <cstddef>
#include <cstdint>
#include <vector>

namespace orbwatch::remap {

/// Content of a tile and storage of its coordinates. Patches and cells (finer patches) are sampled
/// in blocks, the others pixel by pixel.
enum class TileKind : std::uint8_t {
  Blind,       ///< no pixel is on the ball's picture: filled without reading
  Outside,     ///< every pixel falls outside the source picture: filled without reading
  Patch,       ///< one patch on the grid's nodes
  OwnPatch,    ///< one patch on nodes of its own: fitted, or those of its surface at an edge
  Curved,      ///< cells on a curve through the grid's nodes
  Fine,        ///< cells on nodes every 8 px
  CurvedFine,  ///< cells on a curve through such nodes
  Split,       ///< a patch on either side of an edge
  Pixels,      ///< a coordinate or a marker for each pixel
};
constexpr bool is_empty(TileKind kind) { return kind <= TileKind::Outside; }
constexpr bool is_patch(TileKind kind) {
  return kind == TileKind::Patch || kind == TileKind::OwnPatch;
}
/// True if every pixel has a coordinate: only tiles of single pixels may have markers.
constexpr bool is_defined_throughout(TileKind kind) {
  return kind >= TileKind::Patch && kind <= TileKind::Split;
}
/// True if the grid stores such a tile in memory beyond its nodes.
constexpr bool has_store(TileKind kind) {
  return kind == TileKind::OwnPatch || kind >= TileKind::Fine;
}

/// The highest mip level of a source: an eighth of its size.
inline constexpr int kMaxLevel = 3;

struct Tile {
  TileKind kind = TileKind::Blind;
  /// True if every pixel of the whole tile, also beyond the view's border, is defined and as far
  /// within the source as is_interior() requires.
  bool interior = false;
  /// The source's mip level for which a view smaller than the source does not alias: 0..kMaxLevel.
  /// Coordinates count pixels of level 0.
  std::uint8_t level = 0;
  std::uint32_t index = 0;  ///< index in its store; without one, the tile's number, row by row
};

/// A grid's tiles in a byte each. The index of a tile with a store follows from the number of such
/// tiles before it, so that a table without any needs no more memory. Reentrant to read.
class TileTable {
 public:
  TileTable() = default;
  explicit TileTable(std::size_t count) : records_(count) {}

  Tile operator[](std::size_t number) const {
    const Record& record = records_[number];
    return {record.kind, record.interior, record.level,
            has_store(record.kind) ? index(number) : static_cast<std::uint32_t>(number)};
  }

  /// Tiles with a store must be set in ascending order.
  void set(std::size_t number, const Tile& tile) {
    records_[number] = Record{tile.kind, tile.interior, tile.level};
    if (has_store(tile.kind)) set_index(number, tile.index);
  }

  std::size_t bytes() const {
    return records_.size() * sizeof(Record) + words_.size() * sizeof(Word) +
           indices_.size() * sizeof(indices_.front());
  }

 private:
  struct Record {
    TileKind kind : 4 = TileKind::Blind;
    bool interior : 1 = false;
    std::uint8_t level : 2 = 0;
  };
  static_assert(sizeof(Record) == 1 && kMaxLevel < 4);

  /// Bit mask of those among 64 tiles that have a store, and the number of such tiles before them.
  struct Word {
    std::uint64_t own = 0;
    std::uint32_t before = 0;
  };

  std::uint32_t index(std::size_t number) const {
    const Word& word = words_[number / 64];
    const std::uint64_t earlier = word.own & ((std::uint64_t{1} << (number % 64)) - 1);
    return indices_[word.before + static_cast<std::uint32_t>(std::popcount(earlier))];
  }

  void set_index(std::size_t number, std::uint32_t index) {
    // Words between the last tile and this one have no tiles with a store.
    const auto before = static_cast<std::uint32_t>(indices_.size());
    while (words_.size() <= number / 64) words_.push_back({0, before});
    words_.back().own |= std::uint64_t{1} << (number % 64);
    indices_.push_back(index);
  }

  std::vector<Record> records_;
  std::vector<Word> words_;             ///< empty when no tile has a store
  std::vector<std::uint32_t> indices_;  ///< indices of those tiles in their stores
};

}  // namespace orbwatch::remap
