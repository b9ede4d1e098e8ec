// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstdint>
#include <limits>

namespace orbwatch::remap {

/// Views are cut into tiles of 16x16 pixels; the grid has a node at each tile's corner.
inline constexpr int kTile = 16;
/// Source coordinates are fixed point with this many fraction bits (Q13).
inline constexpr int kFractionBits = 13;
/// Largest error of the grid against the exact map, in pixels of a tile's mip level: 2^level source
/// pixels.
inline constexpr double kTolerance = 1.0 / 64;

/// A place in the source picture, Q13 pixels; or u is a marker instead.
struct Coordinate {
  std::int32_t u = 0;
  std::int32_t v = 0;
};
inline constexpr std::int32_t kBlind = std::numeric_limits<std::int32_t>::min();
inline constexpr std::int32_t kOutside = kBlind + 1;
constexpr bool is_defined(const Coordinate& c) { return c.u > kOutside; }

/// Rows of tiles [first, last) of a view: the unit of work that threads share.
struct TileRows {
  int first = 0;
  int last = 0;
};

/// One row of a tile, and all of its rows.
using CoordinateRow = std::array<Coordinate, kTile>;
using CoordinateTile = std::array<CoordinateRow, kTile>;

}  // namespace orbwatch::remap
