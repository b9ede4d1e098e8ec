#pragma once

#include <vector>

#include "proc/align/place/adjustment.h"
#include "proc/align/place/placement.h"

namespace orbwatch::align {

/// Places near which the solution may be, the likeliest first and at most a few, for a request
/// whose numbers are checked. Nothing of them needs a guess: outlines give the ball in the camera
/// frame, and with it the rays that marks show; points at known distances from the ball's centre
/// lie on them at known places, and the rotation follows from those (Wahba's problem). Centres and
/// focal lengths that are unknown are tried, and those improved that fit best. Single marks may be
/// far off. Empty if the outlines fit no focal length.
std::vector<PlaceState> starts(const PlaceRequest& request);

}  // namespace orbwatch::align
