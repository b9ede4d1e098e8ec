// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <opencv2/core.hpp>
#include <vector>

#include "proc/align/place/adjustment.h"
#include "proc/align/place/placement.h"

namespace orbwatch::align {

/// The solution of a request, its accuracy, and the marks used for it.
struct Solution {
  PlaceState state;
  Equations equations;   ///< at that state
  cv::Mat1d covariance;  ///< covariance of the equations' columns
  std::vector<UsedMark> used;
};

/// The least-squares solution without the marks that contradict it. `request`: checked, with a lens
/// for each camera. Errors: those of place() that need a solution.
Result<Solution> solve(const PlaceRequest& request);

/// A camera's picture of the ball in that state, in ball radii; nullopt if there is none.
std::optional<optics::BallProjection> ball_picture(const PlaceRequest& request,
                                                   const PlaceState& state, std::size_t camera);

}  // namespace orbwatch::align
