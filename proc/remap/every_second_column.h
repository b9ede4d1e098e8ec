#pragma once

#include "proc/remap/dense_sampling.h"

namespace orbwatch::remap {

/// Copies columns 0, 2, 4 .. of `fine`, a part of a tile with kTile columns of `pixel_bytes` (1 to
/// 4) each, into the first kTile / 2 columns of `out`; as many rows as `out` has. Reentrant.
void take_every_second_column(const TargetPlane& fine, int pixel_bytes, const TargetPlane& out);

}  // namespace orbwatch::remap
