// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "proc/remap/grid/coordinate.h"
#include "proc/remap/grid/patch.h"

namespace orbwatch::remap {

/// Nodes of the patch that fits the pixels of a tile, all defined, best: of maps of third order,
/// its largest error is less than three quarters of that of the patch through the tile's own
/// corners.
Stencil fitted_nodes(const CoordinateTile& pixels);

/// The largest distance between a patch and the pixels of a tile, Q13.
double largest_error(const Patch& patch, const CoordinateTile& pixels);

}  // namespace orbwatch::remap
