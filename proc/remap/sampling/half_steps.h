#pragma once

#include <array>
#include <cstdint>

#include "proc/remap/grid/coordinate.h"
#include "proc/remap/kernel/kernel_map.h"

namespace orbwatch::remap {

/// Where the pixels of an oversampled tile lie (downsampling.h): a quarter of a step before and
/// behind the pixels of the tile along either axis. A pixel's step is the mean of those from the
/// pixel before and to the one behind, or the one there is: those to markers and to other surfaces
/// do not count.
class HalfSteps {
 public:
  /// Of the tile's first `columns` x `rows` pixels, 8 or 16 each way.
  HalfSteps(const CoordinateTile& tile, int columns, int rows);

  /// The 16x16 pixels from the oversampled tile's pixel (left, top) on, 0 or 16 each. Markers stay.
  void locate(int left, int top, Places& quarter) const;

 private:
  using Plane = std::array<std::array<std::int32_t, kTile>, kTile>;
  /// A coordinate or a quarter of a step of each pixel, Q13.
  struct Pixels {
    alignas(64) Plane u, v;
  };

  Pixels here_, along_x_, along_y_;
};

}  // namespace orbwatch::remap
