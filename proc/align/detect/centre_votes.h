// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "proc/align/detect/picture/slopes.h"
#include "proc/optics/vec.h"

namespace orbwatch::align {

/// Places that many slopes point to or from, at a distance between `nearest` and `farthest` pixels:
/// near its limb a ball compresses the reflection along its radius. At most `most` places within
/// the picture, the best first. Reentrant.
std::vector<optics::Vec2> centre_votes(const Slopes& slopes, double nearest, double farthest,
                                       std::size_t most);

}  // namespace orbwatch::align
