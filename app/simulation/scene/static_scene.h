// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>

#include "app/simulation/machine.h"

namespace orbwatch::app::simulation {

/// Surfaces of the static scene; left and right from the operator's view at the front.
enum class Surface : std::uint8_t {
  Left,
  Right,
  Front,
  Back,
  Floor,
  Ceiling,
  Table,
  Workpiece,
  Outside,  ///< no surface: the ray of a camera outside misses the enclosure
};

/// First static surface that a ray hits, without the ball.
struct StaticHit {
  double distance = kNever;  ///< mm
  Surface surface = Surface::Outside;
  Vec3 normal;  ///< unit length, towards the ray's side
};

/// Nearest surface along a ray. Reentrant.
StaticHit nearest_static(const MachineSettings& settings, const Ray& ray);

/// Distance to table or workpiece only, or kNever. Reentrant.
double obstacle_distance(const MachineSettings& settings, const Ray& ray);

/// Line of sight: a ray and its reflection in the ball by plain vectors, without a ball model.
struct Sight {
  Ray direct;
  double ball_distance = kNever;  ///< mm along `direct`; kNever: it misses the ball
  Ray mirrored;                   ///< starts on the ball, if it is hit

  bool on_ball() const { return ball_distance < kNever; }
};

/// Ignores objects in front of the ball. Reentrant.
inline Sight sight_along(const Ray& ray, const Sphere& ball) {
  Sight sight{ray, entry(ray, ball), {}};
  if (sight.on_ball()) {
    const Vec3 point = ray.at(sight.ball_distance);
    const Vec3 normal = (point - ball.centre) * (1 / ball.radius);
    sight.mirrored = {point, ray.direction - normal * (2 * dot(ray.direction, normal))};
  }
  return sight;
}

/// End of a line of sight on the static scene.
struct StaticEnd {
  Ray ray;  ///< last part of the line of sight
  StaticHit hit;
};

/// Follows a line of sight to the static scene. Reentrant.
StaticEnd static_end(const MachineSettings& settings, const Sight& sight);

}  // namespace orbwatch::app::simulation
