// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "proc/align/place/adjustment.h"
#include "proc/align/place/placement.h"

namespace orbwatch::align {

/// Initial states near the solution, the likeliest first and at most a few, for a request whose
/// numbers are checked. None of them needs a guess: outlines give the ball in the camera frame, and
/// with it the rays of the marks; points at known distances from the ball's centre lie on these
/// rays at known places, and the rotation follows from those (Wahba's problem). Unknown centres and
/// focal lengths are sampled, and the best ones improved. Single marks may be far off. Empty if the
/// outlines fit no focal length.
std::vector<PlaceState> starts(const PlaceRequest& request);

}  // namespace orbwatch::align
