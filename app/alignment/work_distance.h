// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <span>

#include "proc/optics/rig.h"
#include "proc/optics/view_projection.h"

namespace orbwatch::app {

/// Millimetres from the ball's centre to the work piece: to the stated scene in the middle of a
/// measured view, of several views the farthest. NaN: no view shows anything at a stated distance.
/// Reentrant.
double work_distance(const optics::Rig& rig, std::span<const optics::ViewSpec> measured_views);

}  // namespace orbwatch::app
