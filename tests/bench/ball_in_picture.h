// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>

#include "proc/optics/ball_projection.h"
#include "proc/remap/colour/colour_map.h"

namespace orbwatch::bench {

/// A ball that fills most of a picture's height, seen from `yaw` degrees, far away.
optics::BallProjection ball_in_picture(int width, int height, double yaw);

/// A colour map.
remap::ColourMap::Table ramp();

}  // namespace orbwatch::bench
