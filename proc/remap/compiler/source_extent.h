#pragma once

#include <cstdint>

#include "proc/remap/compiler/tolerance.h"
#include "proc/remap/grid/coordinate.h"

namespace orbwatch::remap {

/// One axis of the source picture. Pixels are squares around their centres, so the picture reaches
/// half a pixel further.
struct SourceExtent {
  static constexpr std::int32_t kHalf = 1 << (kFractionBits - 1);
  static constexpr auto kMargin = static_cast<std::int32_t>(kTolerated);
  std::int32_t low = -kHalf;
  std::int32_t high;

  explicit SourceExtent(int size) : high(((size - 1) << kFractionBits) + kHalf) {}

  bool holds(std::int32_t c) const { return c >= low && c <= high; }
  /// The same for coordinates that may be off by the tolerance.
  bool surely_holds(std::int32_t lowest, std::int32_t highest) const {
    return lowest > low + kMargin && highest < high - kMargin;
  }
  bool surely_misses(std::int32_t lowest, std::int32_t highest) const {
    return highest < low - kMargin || lowest > high + kMargin;
  }
};

// Kernels read a window of 8x8 source samples for each block of 4x4 pixels, without a check of the
// picture's border. A window begins less than 6 samples before the least coordinate of its block
// (see BlockMap: what all blocks of a tile need is at most 6 samples wide) and ends less than 8
// behind it; in the chroma of 4:2:0 that is 12 and 16 pixels of the picture, and rounding takes the
// rest. All of it doubles from level to level.
inline constexpr int kInteriorBefore = 14;  ///< px; no coordinate is below it
inline constexpr int kInteriorBeyond = 18;  ///< px; no coordinate is above the size less this

/// Whether a kernel may read around every coordinate from `lowest` to `highest` along an axis of
/// `size` pixels, Q13, at that level.
constexpr bool is_interior(std::int32_t lowest, std::int32_t highest, int size, int level) {
  const std::int64_t before = std::int64_t{kInteriorBefore} << level;
  const std::int64_t beyond = size - (std::int64_t{kInteriorBeyond} << level);
  return lowest >= before << kFractionBits && highest <= beyond * (1 << kFractionBits);
}

}  // namespace orbwatch::remap
