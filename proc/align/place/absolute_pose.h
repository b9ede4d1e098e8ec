// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <vector>

#include "proc/optics/vec.h"

/// First poses in closed form and by few iterations. Lengths in ball radii.
namespace orbwatch::align {

/// A point of the machine and the reflected ray that shows it.
struct PointSight {
  optics::Vec3 point;  ///< machine frame
  optics::Ray ray;     ///< camera frame, relative to the ball's centre
};

/// x_camera = rotation (X - C) for a known centre C of the ball.
struct Attitude {
  optics::Mat3 rotation;
  double badness = 0;  ///< sum over the points of the squared angle, each limited
};

/// The rotation that most points agree on: the best of all pairs' rotations, improved with the
/// points that fit it (Wahba's problem). nullopt for less than two points outside of the ball.
/// Reentrant.
std::optional<Attitude> attitude_around(const std::vector<PointSight>& sights,
                                        const optics::Vec3& centre);

/// A centre with its best rotation.
struct FreePose {
  optics::Vec3 centre;
  double badness = 0;
};

/// The centre next to `guess` from which the rays meet the points best: rotation and position in
/// turn, each by least squares (orthogonal iteration for a camera without a single viewpoint,
/// Schweighofer and Pinz, BMVC 2008), points that fit badly having less weight. nullopt when it
/// does not converge. Reentrant.
std::optional<FreePose> free_pose(const std::vector<PointSight>& sights, const optics::Vec3& guess);

}  // namespace orbwatch::align
