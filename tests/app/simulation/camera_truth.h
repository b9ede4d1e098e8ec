// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cmath>
#include <numbers>

#include "app/simulation/tracing/pinhole.h"

namespace orbwatch::app::simulation {

/// The ball's silhouette in a picture whose camera looks at the ball's centre: a circle, in pixels.
struct BallOutline {
  double cx = 0;
  double cy = 0;
  double radius = 0;
};

/// Rig of a simulated camera that looks at the ball's centre; exact, from geometry alone, without
/// the product's optics.
struct CameraTruth {
  BallOutline outline;
  double alpha = 0;  ///< degrees, the reflected field of view: 360 - 2 asin(ball radius / distance)

  /// Rotation in v_machine = rotation v_camera, where v_camera is a direction in the frame of a
  /// photo with no calibration (the camera is on +Y of the ball and looks along -Y, up is +Z).
  optics::Mat3 rotation;
};

inline CameraTruth truth_of(const Pinhole& camera, const Sphere& ball) {
  const double half_angle = std::asin(ball.radius / norm(ball.centre - camera.position));
  const optics::Mat3& axes = camera.rotation;
  return {{camera.cx(), camera.cy(), camera.focal_length * std::tan(half_angle)},
          360 - 2 * half_angle * 180 / std::numbers::pi,
          optics::transposed({-axes.row0, -axes.row2, -axes.row1})};
}

}  // namespace orbwatch::app::simulation
