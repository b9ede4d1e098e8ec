// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cmath>
#include <numbers>

#include "app/simulation/tracing/ray.h"
#include "proc/optics/vec.h"

namespace orbwatch::app::simulation {

/// Camera without distortion. Camera frame: x right, y down, z forward; machine to camera is x_cam
/// = rotation (X - position); u = focal_length x / z + cx; pixel centres at integers.
struct Pinhole {
  Vec3 position;          ///< mm, machine frame
  optics::Mat3 rotation;  ///< rows: the camera's x, y and z axis in the machine frame
  int width = 0;          ///< pixels
  int height = 0;
  double focal_length = 0;  ///< pixels

  double cx() const { return (width - 1) * 0.5; }
  double cy() const { return (height - 1) * 0.5; }

  /// Ray that arrives at a point of the picture. Reentrant.
  Ray ray_through(double u, double v) const {
    return {position, normalized(rotation.row0 * (u - cx()) + rotation.row1 * (v - cy()) +
                                 rotation.row2 * focal_length)};
  }
};

/// Camera at `position` that looks at `target` with the picture's up as near to +Z as possible (+Y
/// when it looks straight up or down). `horizontal_fov`: degrees from picture edge to edge.
/// Reentrant.
inline Pinhole look_at(const Vec3& position, const Vec3& target, double horizontal_fov, int width,
                       int height) {
  constexpr double kVertical = 1e-9;  // sine of the angle below which +Z does not define up
  const Vec3 forward = normalized(target - position);
  Vec3 right = cross(forward, {0, 0, 1});
  if (norm(right) < kVertical) right = cross(forward, {0, 1, 0});
  right = normalized(right);
  const Vec3 down = cross(forward, right);
  const double half_fov = horizontal_fov * std::numbers::pi / 360;
  return {position, {right, down, forward}, width, height, width * 0.5 / std::tan(half_fov)};
}

}  // namespace orbwatch::app::simulation
