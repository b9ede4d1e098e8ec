#pragma once

#include <optional>

#include "proc/optics/ball_projection.h"
#include "proc/optics/vec.h"

namespace orbwatch::align {

/// What a pixel shows lies somewhere on a ray that starts on the ball. Relative to the ball's
/// centre, in ball radii. Closeness: ball radius / distance from the ball's centre.
struct LineOfSight {
  optics::Vec3 origin;
  optics::Vec3 direction;  ///< unit vector
};

/// nullopt outside of the limb. Reentrant.
std::optional<LineOfSight> line_of_sight(const optics::BallProjection& ball,
                                         const optics::Vec2& pixel);

/// The same of a camera that is turned about the ball. Reentrant.
inline LineOfSight turned(const LineOfSight& line, const optics::Mat3& rotation) {
  return {rotation * line.origin, rotation * line.direction};
}

/// From the ball's centre to the line's point at `closeness`, below 1: a unit vector. Smooth, also
/// a little beyond closeness 0. Reentrant.
optics::Vec3 direction_at(const LineOfSight& line, double closeness);

/// How close a room is of which nothing is stated: a normal distribution of what both cameras see.
struct RoomCloseness {
  double mean = 0;
  double spread = 0;  ///< standard deviation
};

/// Where two lines of sight to the same thing come nearest to each other.
struct Meeting {
  double closeness = 0;
  optics::Vec3 apart;  ///< there: the direction of the first less that of the second
  optics::Vec3 slope;  ///< of `apart`, per closeness
};

/// The closeness with the least (apart / sigma)^2 + ((closeness - mean) / spread)^2. `sigma`:
/// radians. Reentrant.
Meeting meeting(const LineOfSight& first, const LineOfSight& second, double sigma,
                const RoomCloseness& room);

}  // namespace orbwatch::align
