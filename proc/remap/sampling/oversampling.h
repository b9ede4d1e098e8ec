#pragma once

#include <array>
#include <cstdint>

#include "proc/remap/grid/coordinate.h"
#include "proc/remap/kernel/kernel.h"

namespace orbwatch::remap {

/// A tile of twice the pixels along either axis, in rows of 2 kTile pixels.
struct OversampledTile {
  static constexpr int kSide = 2 * kTile;
  alignas(64) std::array<std::uint8_t, kSide * kSide * 6> samples;

  static std::ptrdiff_t stride(Layout layout) {
    return std::ptrdiff_t{kSide} * info(layout).out_bytes();
  }
};

/// The coordinates of a quarter of an oversampled tile, that from its pixel (left, top) on, which
/// lie a quarter of a pixel before and behind those of the tile's first `columns` x `rows` pixels.
void at_half_steps(const CoordinateTile& tile, int columns, int rows, int left, int top,
                   CoordinateTile& quarter);

/// Fills a target with the means of 2x2 pixels. Reentrant.
void average(const OversampledTile& tile, Layout layout, const TargetPlane& out);

}  // namespace orbwatch::remap
