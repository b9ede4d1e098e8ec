// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>

#include "proc/optics/ball_projection.h"
#include "proc/optics/vec.h"

namespace orbwatch::align {

/// Ray that starts on the ball and contains the point that a pixel shows. Relative to the ball's
/// centre, in ball radii. Closeness: ball radius / distance from the ball's centre.
struct LineOfSight {
  optics::Vec3 origin;
  optics::Vec3 direction;  ///< unit vector
};

/// nullopt outside of the limb. Reentrant.
std::optional<LineOfSight> line_of_sight(const optics::BallProjection& ball,
                                         const optics::Vec2& pixel);

/// The same line for a camera that is turned about the ball. Reentrant.
inline LineOfSight turned(const LineOfSight& line, const optics::Mat3& rotation) {
  return {rotation * line.origin, rotation * line.direction};
}

/// Unit vector from the ball's centre to the line's point at `closeness`, below 1. Smooth, also
/// slightly beyond closeness 0. Reentrant.
optics::Vec3 direction_at(const LineOfSight& line, double closeness);

/// Closeness in an unstated room: a normal distribution over the things that both cameras see.
struct RoomCloseness {
  double mean = 0;
  double spread = 0;  ///< standard deviation
};

/// The closest approach of two lines of sight to the same thing.
struct Meeting {
  double closeness = 0;
  optics::Vec3 apart;  ///< direction of the first less that of the second, at that closeness
  optics::Vec3 slope;  ///< derivative of `apart` by closeness
};

/// The closeness with the least (apart / sigma)^2 + ((closeness - mean) / spread)^2. `sigma`:
/// radians. Reentrant.
Meeting meeting(const LineOfSight& first, const LineOfSight& second, double sigma,
                const RoomCloseness& room);

}  // namespace orbwatch::align
