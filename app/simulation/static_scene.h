#pragma once

#include <cstdint>

#include "app/simulation/machine.h"

namespace orbwatch::app::simulation {

/// What stands still, by its place; left and right as the operator at the front sees it.
enum class Surface : std::uint8_t {
  Left,
  Right,
  Front,
  Back,
  Floor,
  Ceiling,
  Table,
  Workpiece,
  Outside,  ///< nothing: the ray leads past the enclosure of a camera that looks in from outside
};

/// The first thing at rest that a ray meets; the ball is not among these things.
struct StaticHit {
  double distance = kNever;  ///< mm
  Surface surface = Surface::Outside;
  Vec3 normal;  ///< unit length, towards the ray's side
};

/// Reentrant.
StaticHit nearest_static(const MachineSettings& settings, const Ray& ray);

/// The distance to table or workpiece alone, kNever when the ray meets neither. Reentrant.
double obstacle_distance(const MachineSettings& settings, const Ray& ray);

/// A ray and what the ball makes of it: plain vector reflection, no model of a mirror ball.
struct Sight {
  Ray direct;
  double ball_distance = kNever;  ///< mm along `direct`; kNever: it misses the ball
  Ray mirrored;                   ///< from the ball on; only if it hits

  bool on_ball() const { return ball_distance < kNever; }
};

/// Whether something stands before the ball is not looked at here. Reentrant.
inline Sight sight_along(const Ray& ray, const Sphere& ball) {
  Sight sight{ray, entry(ray, ball), {}};
  if (sight.on_ball()) {
    const Vec3 point = ray.at(sight.ball_distance);
    const Vec3 normal = (point - ball.centre) * (1 / ball.radius);
    sight.mirrored = {point, ray.direction - normal * (2 * dot(ray.direction, normal))};
  }
  return sight;
}

/// The end of a sight on what stands still.
struct StaticEnd {
  Ray ray;  ///< the last part of the sight
  StaticHit hit;
};

/// Reentrant.
StaticEnd static_end(const MachineSettings& settings, const Sight& sight);

}  // namespace orbwatch::app::simulation
