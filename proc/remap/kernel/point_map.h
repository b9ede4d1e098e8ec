#pragma once

#include <cstdint>

#include "proc/remap/grid/patch.h"

namespace orbwatch::remap {

/// One axis of a patch in lanes of 32 bit: pixel (i, j) lies, in Q13, at
///   base + ((start + i x + j y + i j xy + i i xx + j j yy) >> 5)
/// modulo 2^32; those terms are Q18. Rounding them moves a pixel of a tile by less than 1/700 px.
struct PointAxis {
  static constexpr int kExtraBits = 5;
  std::int32_t base;
  std::uint32_t start;
  std::uint32_t x, y, xy, xx, yy;
};

/// A patch as kernels take it that go pixel by pixel.
struct PointMap {
  PointAxis u, v;

  explicit PointMap(const Patch& patch);
};

/// Pixels are sampled in runs of so many.
inline constexpr int kPointRun = 16;

/// Where each pixel of a rectangle lies in a source, Q13, row by row without gaps; up to the end of
/// the last run.
struct Places {
  alignas(64) std::int32_t u[kTile * kTile];
  alignas(64) std::int32_t v[kTile * kTile];
};

}  // namespace orbwatch::remap
