// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstdint>

#include "proc/remap/grid/coordinate.h"
#include "proc/remap/kernel/kernel_map.h"

namespace orbwatch::remap {

/// Coordinates of the pixels of an oversampled tile (downsampling.h): a quarter of a step before
/// and behind the pixels of the tile along either axis. A pixel's step is the mean of those from
/// the pixel before and to the one behind, or the only one: steps to markers and to other surfaces
/// do not count.
class HalfSteps {
 public:
  /// For the tile's first `columns` x `rows` pixels, 8 or 16 each way.
  HalfSteps(const CoordinateTile& tile, int columns, int rows);

  /// Locates the 16x16 pixels from the oversampled tile's pixel (left, top) on, 0 or 16 each.
  /// Markers are kept.
  void locate(int left, int top, Places& quarter) const;

 private:
  using Plane = std::array<std::array<std::int32_t, kTile>, kTile>;
  /// A coordinate or a quarter of a step for each pixel, Q13.
  struct Pixels {
    alignas(64) Plane u, v;
  };

  Pixels here_, along_x_, along_y_;
};

}  // namespace orbwatch::remap
