#pragma once

#include <cstdint>

#include "proc/remap/coordinate.h"
#include "proc/remap/tolerance.h"

namespace orbwatch::remap {

/// Where a coordinate along one axis stands to the source picture. Pixels are squares around their
/// centres, so the picture reaches half a pixel further.
struct SourceExtent {
  static constexpr std::int32_t kHalf = 1 << (kFractionBits - 1);
  static constexpr auto kMargin = static_cast<std::int32_t>(kTolerated);
  std::int32_t low = -kHalf;
  std::int32_t high;

  explicit SourceExtent(int size) : high(((size - 1) << kFractionBits) + kHalf) {}

  bool holds(std::int32_t c) const { return c >= low && c <= high; }
  /// Also if all of it were off by the tolerance.
  bool surely_holds(std::int32_t lowest, std::int32_t highest) const {
    return lowest > low + kMargin && highest < high - kMargin;
  }
  bool surely_misses(std::int32_t lowest, std::int32_t highest) const {
    return highest < low - kMargin || lowest > high + kMargin;
  }
};

}  // namespace orbwatch::remap
