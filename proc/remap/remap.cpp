// SPDX-License-Identifier: Apache-2.0
#include "proc/remap/remap.h"

#include <cassert>

namespace orbwatch::remap {

void remap(const CoordinateGrid& grid, std::span<const Picture> source, Interpolation interpolation,
           const MutablePicture& out, TileRows rows, const Kernel& kernel) {
  assert(out.width == grid.width() && out.height == grid.height());
  assert(can_remap(source.front().format, out.format));
  const TileRemap tiles(grid, source, interpolation, kernel);
  for (int ty = rows.first; ty < rows.last; ++ty) tiles.write_row(ty, out);
}

}  // namespace orbwatch::remap
