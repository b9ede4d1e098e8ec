// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <span>

#include "proc/optics/vec.h"
#include "proc/optics/view_projection.h"
#include "proc/signals/hot_spot/hot_spot_limits.h"
#include "proc/signals/region.h"

namespace orbwatch::signals {

/// Assumed highest speed of a hot spot, mm/s: above the feed of cladding and welding heads (up to
/// 10 m/min), below that of sparks (metres per second).
inline constexpr double kAssumedSpeed = 200;

/// Limits for a region of interest without stated ones, so that no spark is mistaken for a hidden
/// hot spot: the footprint of the view's finest pixel on the surface as the least area, and
/// kAssumedSpeed, or a pixel per frame if that is more. `outline`: see RegionSettings.
/// `frame_rate`: Hz; 0: not known. Without a surface, or an outline that fits the view: no limits.
/// Reentrant.
HotSpotLimits assumed_limits(const optics::ViewProjection& view, const RegionScene& scene,
                             std::span<const optics::Vec3> outline, double frame_rate);

}  // namespace orbwatch::signals
