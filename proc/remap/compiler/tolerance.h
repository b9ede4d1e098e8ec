// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cmath>
#include <cstdint>

#include "proc/remap/grid/coordinate.h"

/// The allowed and the estimated error of a patch against the exact map, in Q13 pixels, and the
/// part of the source picture that remains usable.
namespace orbwatch::remap {

inline constexpr double kOnePixel = 1 << kFractionBits;
inline constexpr double kTolerated = kTolerance * kOnePixel;
/// Largest error of a patch of level 0 estimated from its nodes: the rest of the tolerance is for
/// terms of higher order than the fourth.
inline constexpr double kClose = 0.85 * kTolerated;
/// The same for a tile of that mip level, where neighbouring pixels are 2^level source pixels and
/// more apart.
constexpr double close_at(int level) { return kClose * (1 << level); }

/// Largest share of five nodes' fourth difference that the fourth-order error can be: the maximum
/// of Lagrange's t (1-t) (1+t) (2-t) / 24.
inline constexpr double kFourthOrder = 0.0235;

inline double distance(const Coordinate& a, const Coordinate& b) {
  const double u = double{1} * a.u - b.u, v = double{1} * a.v - b.v;
  return std::sqrt(u * u + v * v);
}

inline double fourth_order_error(const std::array<Coordinate, 5>& row) {
  constexpr std::array kBinomial{1.0, -4.0, 6.0, -4.0, 1.0};
  double u = 0, v = 0;
  for (std::size_t k = 0; k < row.size(); ++k) {
    u += kBinomial[k] * row[k].u;
    v += kBinomial[k] * row[k].v;
  }
  return kFourthOrder * std::sqrt(u * u + v * v);
}

/// One axis of the source picture. Pixels are squares around their centres, so the picture extends
/// half a pixel further.
struct SourceExtent {
  static constexpr std::int32_t kHalf = 1 << (kFractionBits - 1);
  std::int32_t low = -kHalf;
  std::int32_t high;
  std::int32_t margin;  ///< tolerance of the coordinates

  /// For coordinates of a tile of that mip level.
  explicit SourceExtent(int size, int level = 0)
      : high(((size - 1) << kFractionBits) + kHalf),
        margin(static_cast<std::int32_t>(kTolerated) << level) {}

  bool holds(std::int32_t c) const { return c >= low && c <= high; }
  /// The same for coordinates that may be off by the tolerance.
  bool surely_holds(std::int32_t lowest, std::int32_t highest) const {
    return lowest > low + margin && highest < high - margin;
  }
  bool surely_misses(std::int32_t lowest, std::int32_t highest) const {
    return highest < low - margin || lowest > high + margin;
  }
};

// Kernels read a window of 8x8 source samples for each block of 4x4 pixels, without a check of the
// picture's border. A window begins less than 6 samples before the least coordinate of its block
// (see BlockMap: all blocks of a tile need at most 6 samples in width) and ends less than 8 behind
// it; in the chroma of 4:2:0 that is 12 and 16 pixels of the picture, and rounding accounts for the
// rest. All of it doubles from level to level.
inline constexpr int kInteriorBefore = 14;  ///< px; no coordinate is below it
inline constexpr int kInteriorBeyond = 18;  ///< px; no coordinate is above the size less this

/// True if a kernel may read around every coordinate from `lowest` to `highest` along an axis of
/// `size` pixels, Q13, at that level.
constexpr bool is_interior(std::int32_t lowest, std::int32_t highest, int size, int level) {
  const std::int64_t before = std::int64_t{kInteriorBefore} << level;
  const std::int64_t beyond = size - (std::int64_t{kInteriorBeyond} << level);
  return lowest >= before << kFractionBits && highest <= beyond * (1 << kFractionBits);
}

}  // namespace orbwatch::remap
