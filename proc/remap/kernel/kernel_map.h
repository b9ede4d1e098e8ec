// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>

#include "proc/remap/grid/patch.h"

namespace orbwatch::remap {

/// Side of a block; kernels process a tile in blocks of 4x4 pixels.
inline constexpr int kBlock = 4;
/// Side, in source pixels, of the window that a block's pixels are interpolated from.
inline constexpr int kWindow = 8;

/// A value for each axis.
template <class T>
struct AxisPair {
  T u, v;
};

/// Positions of the blocks' windows, source pixels in Q32: exact, by differences from block to
/// block. The integer part is the window's origin, the fraction the block's place in its window.
struct WindowWalk {
  Uv64 value;           ///< position of block (0, 0)
  Uv64 step_x, step_y;  ///< steps from there to block (1, 0), (0, 1)
  Uv64 xx, yy, xy;      ///< growth of step_x along x, of step_y along y, of each of them along the
                        ///< other axis
};

/// All pixels of a block, relative to the block's place, in 16 bit lanes modulo 2^16. Along either
/// axis pixel (i, j), 0..3 each, of block (bx, by) lies at
///   place + start + bx along_x + by along_y
/// with, in Q13,
///   along_x = (i twice_xx + j xy + 4) >> 3,   along_y = (i xy + j twice_yy + 4) >> 3,
///   start = i slope_x + j slope_y + ((i along_x + j along_y + 4) >> 3) + offset.
/// Lanes of v have two fraction bits less: their along_x, along_y and start are these, rounded; so
/// a row's number is in the bits that index a table of rows of kWindow. They count from kRowCentre
/// above the window, since a lower row is weighted with v - 1/2 (see bilinear.h). Rounding moves a
/// pixel by less than 1/240 px from the quadratic.
struct alignas(8) LaneShape {
  AxisPair<std::int16_t> slope_x, slope_y;    ///< at the corner of block (0, 0); Q13
  AxisPair<std::int16_t> twice_xx, twice_yy;  ///< curvature, Q18
  AxisPair<std::int16_t> xy;                  ///< Q18
  AxisPair<std::uint16_t> offset;             ///< Q13; makes all lanes positive
};

inline constexpr int kRowFractionBits = kFractionBits - 2;
inline constexpr int kRowCentre = 1 << (kRowFractionBits - 1);

/// A map for kernels, over the blocks of a tile, of its half in a subsampled plane, or of the tile
/// at half steps along y.
struct BlockMap {
  WindowWalk windows;
  LaneShape lanes;
  int blocks_x;                  ///< 1, 2 or 4
  int blocks_y;                  ///< 1 to 8
  AxisPair<std::int32_t> reach;  ///< from the first to the last pixel of any block, at most; Q20

  /// True: no block needs more of its window than these columns and rows, neighbours included.
  bool is_within(int columns, int rows) const {
    // A place is within the window's first pixel, the right or lower neighbour one further.
    constexpr int kReachBits = kFractionBits + UvQuadratic::kSlopeBits;
    return reach.u <= (columns - 2) << kReachBits && reach.v <= (rows - 2) << kReachBits;
  }

  /// Sets the map to a patch's first pixels, 4, 8 or 16 columns and a multiple of 4 rows, at
  /// most 32. False, and then undefined, when the patch is too steep or curved: a block would not
  /// fit into its window. `rounding`: see rounding().
  [[nodiscard]] bool fit(const Patch& patch, int columns, int rows, const Uv64& rounding);

  /// Offset of every coordinate, Q24, that rounds truncated places: half of their last bit, and `u`
  /// and `v`, Q13, half of the last bit of a kernel's weights.
  static constexpr Uv64 rounding(int u, int v) {
    const auto half_of_last = [](int bits) {
      return 1 << (kFractionBits + PatchRow::kScaleBits - bits - 1);
    };
    return Uv64{(std::int64_t{u} << PatchRow::kScaleBits) + half_of_last(kFractionBits),
                (std::int64_t{v} << PatchRow::kScaleBits) + half_of_last(kRowFractionBits)};
  }
};

/// One axis of a patch in lanes of 32 bit: pixel (i, j) lies, in Q13, at
///   base + ((start + i x + j y + i j xy + i i xx + j j yy) >> 5)
/// modulo 2^32; those terms are Q18. Rounding them moves a pixel of a tile by less than 1/700 px.
struct PointAxis {
  static constexpr int kExtraBits = 5;
  std::int32_t base;
  std::uint32_t start;
  std::uint32_t x, y, xy, xx, yy;
};

/// A patch in the form used by kernels that sample pixel by pixel.
struct PointMap {
  PointAxis u, v;

  explicit PointMap(const Patch& patch);
};

/// Number of pixels that are sampled together.
inline constexpr int kPointRun = 16;

/// Places of a rectangle's pixels in a source, Q13, row by row without gaps; up to the end of the
/// last run.
struct Places {
  alignas(64) std::int32_t u[kTile * kTile];
  alignas(64) std::int32_t v[kTile * kTile];
};

}  // namespace orbwatch::remap
