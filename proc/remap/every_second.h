#pragma once

#include "proc/remap/plane.h"

namespace orbwatch::remap {

/// Copies rows 0, 2, 4 .. of `fine`, which are `row_bytes` long, a multiple of 8, into the rows of
/// `out`. Reentrant.
void take_every_second_row(const TargetPlane& fine, int row_bytes, const TargetPlane& out);

/// Copies columns 0, 2, 4 .. of `fine`, a part of a tile with kTile columns of `pixel_bytes` (1 to
/// 4) each, into the first kTile / 2 columns of `out`; as many rows as `out` has. Reentrant.
void take_every_second_column(const TargetPlane& fine, int pixel_bytes, const TargetPlane& out);

}  // namespace orbwatch::remap
