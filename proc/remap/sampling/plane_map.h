// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "proc/remap/grid/coordinate.h"
#include "proc/remap/grid/patch.h"
#include "proc/remap/sampling/plane_sampling.h"

namespace orbwatch::remap {

/// Converts a patch of a picture to its mip level `level`. Reentrant.
Patch on_level(Patch patch, int level);

/// The same for a tile's coordinates; markers are kept.
void on_level(CoordinateTile& tile, int level);

/// A patch in steps of 2^bits pixels along either axis.
Patch in_steps(Patch patch, int bits);

/// A patch in half steps: pixels 2 X and 2 X + 1 lie a quarter of a pixel before and behind X.
Patch at_half_steps(Patch patch);

/// The same along X, or along Y, alone.
Patch at_half_steps_along_x(Patch patch);
Patch at_half_steps_along_y(Patch patch);

/// A patch in half steps along Y: row 2 Y is row Y.
Patch at_half_rows(Patch patch);

/// A patch in half steps along X: column 2 X is column X.
Patch at_half_columns(Patch patch);

/// The patch's slope at its pixel (x, y).
UvXy32 slope_at(const Patch& patch, int x, int y);

/// The patch relative to its pixel (x, y).
Patch moved(Patch patch, int x, int y);

/// Converts a patch of a picture to a sampling's plane: from the plane's pixels of the view to
/// those of the source. A sampling is in full, 4:2:2 cosited or 4:2:0 centred. Reentrant.
Patch on_plane(Patch patch, const PlaneSampling& sampling);

/// The same for a tile of single coordinates. A plane's pixel that several of the view share lies
/// in their middle; where they are not all on one surface, at the first's place.
void on_plane(const CoordinateTile& picture, const PlaneSampling& sampling, CoordinateTile& plane);

}  // namespace orbwatch::remap
