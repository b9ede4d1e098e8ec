// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <span>

#include "proc/optics/vec.h"

namespace orbwatch::align {

/// Two unit vectors that differ only by the rotation sought.
struct DirectionPair {
  optics::Vec3 reference;
  optics::Vec3 camera;
  double weight = 1;
};

/// The rotation R with the least weighted squares of R camera - reference (Wahba's problem, solved
/// by singular values: Markley 1988). Two pairs that are not parallel determine it. Reentrant.
optics::Mat3 fit_rotation(std::span<const DirectionPair> pairs);

/// The turn by |turn| radians about `turn` (Rodrigues). Reentrant.
optics::Mat3 rotation_about(const optics::Vec3& turn);

/// The smallest angle between two rotations, radians. Reentrant.
double angle_between(const optics::Mat3& a, const optics::Mat3& b);

}  // namespace orbwatch::align
