// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <vector>

#include "proc/remap/grid/coordinate.h"
#include "proc/remap/grid/patch.h"

namespace orbwatch::remap {

// Storage of tiles that the grid's nodes do not describe; the one with the least memory is tried
// first. Each has row `y`, 0..15, as coordinates or markers.

/// A tile on two surfaces of the scene: a patch on nodes of each, and the side of each pixel.
/// Places are those of PointMap.
struct SplitTile {
  std::array<Stencil, 2> sides;
  std::array<std::uint16_t, kTile> second;  ///< bit x of word y: the pixel is on sides[1]

  CoordinateRow row(int y) const;
  /// All rows; faster than row by row.
  CoordinateTile pixels() const;
};

/// A tile with so much curvature that it needs nodes every `Cell` pixels: patches between (16 /
/// Cell + 1)^2 nodes with a ring of one around them.
template <int Cell>
struct FineTile {
  static constexpr int kCells = kTile / Cell;
  static constexpr int kNodes = kCells + 3;
  std::array<std::array<Coordinate, kNodes>, kNodes> nodes;

  /// The nodes of cell (i, j), 0..kCells - 1.
  Stencil stencil(int i, int j) const;
  /// The map in that cell, in pixels of the view relative to its corner.
  Patch patch(int i, int j) const;
  CoordinateRow row(int y) const;
  /// All rows; faster than row by row.
  CoordinateTile pixels() const;
};

/// The tile between the middle four of the grid's nodes where the map is too curved for a Patch but
/// a third-order curve follows it: along the rows and columns, nodes come from such curves through
/// the twelve nodes used, and between them from a Coons patch.
FineTile<8> curved_tile(const Stencil& nodes);
/// The same between nodes every 8 px.
FineTile<4> curved_tile(const FineTile<8>& fine);

/// A tile's coordinates in four bytes per pixel: offsets from the tile's least u and v, in the
/// finest power of two of Q13 steps that spans the tile.
class PackedTile {
 public:
  /// nullopt for a tile that spans more than 255 px: a step would be coarser than 1/256 px.
  static std::optional<PackedTile> pack(const CoordinateTile& tile);

  CoordinateRow row(int y) const;
  CoordinateTile pixels() const;

 private:
  struct Offset {
    std::uint16_t u;  ///< or a marker
    std::uint16_t v;
  };
  Coordinate least_;
  int shift_ = 0;
  std::array<std::array<Offset, kTile>, kTile> offsets_;
};

/// Tiles stored pixel by pixel: packed, or whole where a tile spans too much of the source for
/// that.
class PixelTiles {
 public:
  /// Adds a tile and returns its index.
  std::uint32_t add(const CoordinateTile& tile);
  CoordinateRow row(std::uint32_t index, int y) const;
  CoordinateTile pixels(std::uint32_t index) const;

  void shrink_to_fit();
  std::size_t bytes() const;

 private:
  static constexpr std::uint32_t kWhole = std::uint32_t{1} << 31;  ///< flag of an index in whole_

  std::vector<PackedTile> packed_;
  std::vector<CoordinateTile> whole_;
};

}  // namespace orbwatch::remap
