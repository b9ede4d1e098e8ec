// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "proc/optics/ball_projection.h"
#include "proc/optics/view_projection.h"

namespace orbwatch::optics {

/// Source pixels per degree in `direction`, along the worse of the picture's two main directions:
/// the smaller singular value of d(source pixel) / d(direction) at that distance from the ball, for
/// an object that faces it. 0 in the blind cone, and decreasing to 0 towards it.
double resolution(const BallProjection& ball, const Vec3& direction);

/// resolution() at every pixel of a view, row by row; also 0 beyond the end of the view's
/// projection and where the source picture of this size cuts the ball. Takes about a second for
/// 1080p.
std::vector<float> resolution_map(const ViewProjection& view, const BallProjection& ball,
                                  int source_width, int source_height);

}  // namespace orbwatch::optics
