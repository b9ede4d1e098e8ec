#pragma once

#include <cstdint>

#include "proc/remap/coordinate.h"

namespace orbwatch::remap {

/// What a kernel does with a tile.
enum class TileClass : std::uint8_t {
  Blind,    ///< no pixel is on the ball's picture: filled without reading
  Outside,  ///< every pixel falls outside the source picture: filled without reading
  Patch,    ///< one smooth patch
  Dense,    ///< row by row, each pixel a coordinate or a marker
};

/// Where a tile's coordinates are kept.
enum class TileStore : std::uint8_t {
  Grid,      ///< the grid's nodes, as a Patch
  Curved,    ///< the grid's nodes, as a curved_tile()
  OwnNodes,  ///< a Patch on nodes of its own
  Split,
  Fine,        ///< patches on nodes every 8 px
  CurvedFine,  ///< the same nodes, as a curved_tile()
  Packed,
  Whole
};
/// Whether a tile needs nothing but the grid's nodes.
constexpr bool is_on_grid(TileStore store) {
  return store == TileStore::Grid || store == TileStore::Curved;
}

/// A grid asks for no level of the source above this one: an eighth of its size.
inline constexpr int kMaxLevel = 3;

struct Tile {
  TileClass kind = TileClass::Blind;
  TileStore store = TileStore::Grid;  ///< Patch: Grid or OwnNodes; Dense: the others
  /// Every pixel of the whole tile, also beyond the view's border, is defined and as far within the
  /// source as is_interior() asks.
  bool interior = false;
  /// How often the source should be halved before it is sampled here, so that a view smaller than
  /// the source does not alias: 0..kMaxLevel. Coordinates count pixels of the full source.
  std::uint8_t level = 0;
  std::uint32_t index = 0;  ///< in its store; of a tile on the grid its number, row by row
};

/// Every pixel of the tile has a coordinate: only tiles kept pixel by pixel may have markers.
constexpr bool is_defined_throughout(const Tile& tile) {
  const bool by_pixel = tile.store == TileStore::Packed || tile.store == TileStore::Whole;
  return tile.kind == TileClass::Patch || (tile.kind == TileClass::Dense && !by_pixel);
}

// Kernels read a window of 8x8 source samples for each block of 4x4 pixels without asking where the
// picture ends. A window begins less than 6 samples before the least coordinate of its block (see
// BlockMap: what all blocks of a tile need is at most 6 samples wide) and ends less than 8 behind
// it; in the chroma of 4:2:0 that is 12 and 16 pixels of the picture, and rounding takes the rest.
// All of it doubles from level to level.
inline constexpr int kInteriorBefore = 14;  ///< px; no coordinate is below it
inline constexpr int kInteriorBeyond = 18;  ///< px; no coordinate is above the size less this

/// Whether a kernel may read around every coordinate from `lowest` to `highest` along an axis of
/// `size` pixels, Q13, at that level.
constexpr bool is_interior(std::int32_t lowest, std::int32_t highest, int size, int level) {
  const std::int64_t before = std::int64_t{kInteriorBefore} << level;
  const std::int64_t beyond = size - (std::int64_t{kInteriorBeyond} << level);
  return lowest >= before << kFractionBits && highest <= beyond * (1 << kFractionBits);
}

/// The square of the largest step between neighbouring pixels, in source pixels, for which one
/// bilinear sample a pixel will do: from there on it loses more than averaging would.
inline constexpr float kLargestStep2 = 1.4F * 1.4F;

/// The level for steps whose larger square is `step2`: the least at which it is allowed. Without a
/// branch, for loops over many.
constexpr std::int32_t level_of_step2(float step2) {
  static_assert(kMaxLevel == 3);
  return std::int32_t{step2 > kLargestStep2} + std::int32_t{step2 > 4 * kLargestStep2} +
         std::int32_t{step2 > 16 * kLargestStep2};
}
/// 2^level.
constexpr float scale_of_step2(float step2) {
  return (step2 > kLargestStep2 ? 2.0F : 1.0F) * (step2 > 4 * kLargestStep2 ? 2.0F : 1.0F) *
         (step2 > 16 * kLargestStep2 ? 2.0F : 1.0F);
}

}  // namespace orbwatch::remap
