#pragma once

#include <cstdint>

#include "proc/remap/grid/patch.h"
#include "proc/remap/kernel/kernel.h"

/// Samples tiles pixel by pixel, for any map and at the source's borders too, where its outermost
/// pixels are repeated. Reentrant.
namespace orbwatch::remap {

/// Pixels of the target at whole X, Y of the patch.
void sample_points(const Kernel& kernel, Layout layout, const Patch& patch,
                   const SourcePlane& source, const TargetPlane& target);

/// Undefined pixels become `black`.
void sample_points(const Kernel& kernel, Layout layout, const CoordinateTile& coordinates,
                   std::uint8_t black, const SourcePlane& source, const TargetPlane& target);

}  // namespace orbwatch::remap
