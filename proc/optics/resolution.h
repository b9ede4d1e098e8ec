#pragma once

#include <vector>

#include "proc/optics/ball_projection.h"
#include "proc/optics/view_projection.h"

namespace orbwatch::optics {

/// How many source pixels a degree has at what `direction` shows, in the worse of the picture's two
/// main directions: the smaller singular value of d(source pixel) / d(direction) at that distance
/// from the ball, as for a thing that faces it. 0 in the blind cone. Towards the blind side it
/// falls to 0, since the ball squeezes the room there.
double resolution(const BallProjection& ball, const Vec3& direction);

/// resolution() at every pixel of a view, row by row: 0 also where the view's projection ends and
/// where the source picture of this size cuts the ball. Takes about a second for 1080p.
std::vector<float> resolution_map(const ViewProjection& view, const BallProjection& ball,
                                  int source_width, int source_height);

}  // namespace orbwatch::optics
