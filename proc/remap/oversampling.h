#pragma once

#include <array>
#include <cstdint>

#include "proc/remap/coordinate.h"
#include "proc/remap/dense_sampling.h"
#include "proc/remap/kernel.h"

namespace orbwatch::remap {

/// A tile of twice the pixels along either axis, in rows of 2 kTile pixels.
struct OversampledTile {
  static constexpr int kSide = 2 * kTile;
  alignas(64) std::array<std::uint8_t, kSide * kSide * 4> samples;

  static std::ptrdiff_t stride(Layout layout) {
    return std::ptrdiff_t{kSide} * info(layout).out_bytes();
  }
};

/// Fills a target with the means of 2x2 pixels. Reentrant.
void average(const OversampledTile& tile, Layout layout, const TargetPlane& out);

}  // namespace orbwatch::remap
