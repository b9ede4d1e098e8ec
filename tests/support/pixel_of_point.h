// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>

#include "proc/optics/ball_projection.h"

namespace orbwatch::tests {

/// The pixel that shows a point, machine frame, mm. nullopt in the blind cone and within the ball.
inline std::optional<optics::Vec2> pixel_of_point(const optics::BallProjection& projection,
                                                  const optics::Vec3& point) {
  const optics::Ball& ball = projection.ball();
  const optics::Vec3 offset = point - ball.centre;
  const double distance = optics::norm(offset);
  if (!(distance >= ball.radius)) return std::nullopt;
  return projection.pixel(offset * (1 / distance), ball.radius / distance);
}

}  // namespace orbwatch::tests
