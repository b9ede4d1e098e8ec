// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "app/simulation/machine.h"
#include "app/simulation/tracing/pinhole.h"

namespace orbwatch::app::simulation {

/// Machine with default settings.
inline const MachineSettings kMachine;
inline const Sphere kBall = kMachine.ball;

/// Pixel that shows a point directly, not by the ball.
inline optics::Vec2 project(const Pinhole& camera, const Vec3& point) {
  const Vec3 c = camera.rotation * (point - camera.position);
  return {camera.focal_length * c.x / c.z + camera.cx(),
          camera.focal_length * c.y / c.z + camera.cy()};
}

}  // namespace orbwatch::app::simulation
