// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstdint>

#include "proc/remap/grid/coordinate.h"
#include "proc/remap/kernel/kernel.h"
#include "proc/remap/kernel/layout.h"

namespace orbwatch::remap {

/// Writes `width` pixels, each the mean of 2x2 from two rows of a plane, rounded to nearest: the
/// samples that the layout reads, at their places in a pixel. Reentrant.
using BoxFilter = void (*)(const std::uint8_t* upper, const std::uint8_t* lower, std::uint8_t* out,
                           int width);
BoxFilter box_filter(Layout layout);

/// Copies rows 0, 2, 4 .. of `fine`, which are `row_bytes` long, a multiple of 8, into the rows of
/// `out`. Reentrant.
void keep_even_rows(const TargetPlane& fine, int row_bytes, const TargetPlane& out);

/// Copies columns 0, 2, 4 .. of `fine`, a part of a tile with kTile columns of `pixel_bytes` (1 to
/// 4) each, into the first kTile / 2 columns of `out`; as many rows as `out` has. Reentrant.
void keep_even_columns(const TargetPlane& fine, int pixel_bytes, const TargetPlane& out);

/// The axes along which each pixel of a target is the mean of two samples, a quarter of a pixel
/// before and behind it.
struct TwiceAlong {
  bool x = false, y = false;
};

/// A tile with twice the pixels along an axis or both, in rows of 2 kTile pixels.
struct OversampledTile {
  static constexpr int kSide = 2 * kTile;
  alignas(64) std::array<std::uint8_t, kSide * kSide * 6> samples;

  static constexpr std::ptrdiff_t stride(Layout layout) {
    return std::ptrdiff_t{kSide} * info(layout).out_bytes();
  }
};

/// Fills a target with the means of 2x2, 2x1 or 1x2 pixels, rounded to nearest. `twice`: one axis
/// at least. Reentrant.
void average(const OversampledTile& tile, Layout layout, TwiceAlong twice, const TargetPlane& out);

}  // namespace orbwatch::remap
