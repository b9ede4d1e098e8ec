// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <opencv2/core.hpp>
#include <vector>

#include "proc/image/result.h"
#include "proc/optics/ball_projection.h"
#include "proc/optics/lens.h"
#include "proc/optics/outline.h"
#include "proc/optics/view_projection.h"

namespace orbwatch::align {

/// The projection of a camera that is not placed yet, in its own axes: its registration is the
/// identity, the ball is at the origin. `lens`: none if the camera is not calibrated, which is then
/// assumed at kUncalibratedDistance from the ball, facing it. Error: the outline is not a ball's.
Result<optics::BallProjection> unplaced_projection(const optics::Outline& outline,
                                                   const std::optional<optics::Lens>& lens);
inline constexpr double kUncalibratedDistance = 12;  ///< ball radii

/// Overlapping perspective views all around, except away from the camera, of `side` pixels a side:
/// anything that spans less than 25 degrees lies wholly in one of them.
std::vector<optics::ViewProjection> views_all_around(int side);

/// Renders a view of `luminance`, one channel, un-mirrored, for a scene far away; black where it
/// shows nothing. Reentrant.
cv::Mat mirror_view(const cv::Mat& luminance, const optics::BallProjection& ball,
                    const optics::ViewProjection& view);

}  // namespace orbwatch::align
