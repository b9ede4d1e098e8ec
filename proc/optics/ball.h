#pragma once

#include <cmath>
#include <string>

#include "proc/image/result.h"
#include "proc/optics/vec.h"

namespace orbwatch::optics {

/// The mirror ball in the machine frame, millimetres. A ball of unknown size has radius 1: lengths
/// then count in ball radii.
struct Ball {
  Vec3 centre;
  double radius = 1;
};

/// Error: a radius that is not above 0, numbers that are not finite.
inline Result<> check_ball(const Ball& ball) {
  const Vec3& c = ball.centre;
  if (!std::isfinite(c.x) || !std::isfinite(c.y) || !std::isfinite(c.z)) {
    return fail("the ball's centre must be finite numbers");
  }
  if (ball.radius > 0 && std::isfinite(ball.radius)) return {};
  return fail("the ball's radius is " + std::to_string(ball.radius) +
              " mm; it must be above 0 and finite");
}

}  // namespace orbwatch::optics
