#pragma once

#include <vector>

#include "proc/align/detect/slopes.h"
#include "proc/optics/vec.h"

namespace orbwatch::align {

/// Where many slopes point to or from, at a distance between `nearest` and `farthest` pixels: near
/// its limb a ball shows everything compressed along its radius. The best places, `most` at most,
/// the best first. They lie within the picture. Reentrant.
std::vector<optics::Vec2> centre_votes(const Slopes& slopes, double nearest, double farthest,
                                       std::size_t most);

}  // namespace orbwatch::align
