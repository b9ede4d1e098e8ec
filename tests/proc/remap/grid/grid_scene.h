// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "proc/optics/ball_projection.h"
#include "proc/remap/grid/coordinate_grid.h"

namespace orbwatch::remap {

/// A ball in the middle of a square picture.
inline optics::BallProjection centred_ball(const optics::BallModel& model, double size,
                                           double radius) {
  return optics::BallProjection::make(model, {{(size - 1) / 2, (size - 1) / 2}, radius, radius, 0},
                                      {})
      .value();
}

/// Calls `look(tile, tx, ty)` for every tile.
template <class Look>
void for_each_tile(const CoordinateGrid& grid, const Look& look) {
  for (int ty = 0; ty < grid.tiles_y(); ++ty) {
    for (int tx = 0; tx < grid.tiles_x(); ++tx) look(grid.tile(tx, ty), tx, ty);
  }
}

}  // namespace orbwatch::remap
