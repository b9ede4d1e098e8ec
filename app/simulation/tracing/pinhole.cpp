#include "app/simulation/tracing/pinhole.h"

#include <cmath>
#include <numbers>

namespace orbwatch::app::simulation {

Pinhole look_at(const Vec3& position, const Vec3& target, double horizontal_fov, int width,
                int height) {
  constexpr double kVertical = 1e-9;  // sine of the angle below which up is not defined by +Z
  const Vec3 forward = normalized(target - position);
  Vec3 right = cross(forward, {0, 0, 1});
  if (norm(right) < kVertical) right = cross(forward, {0, 1, 0});
  right = normalized(right);
  const Vec3 down = cross(forward, right);
  const double half_fov = horizontal_fov * std::numbers::pi / 360;
  return {position, {right, down, forward}, width, height, width * 0.5 / std::tan(half_fov)};
}

}  // namespace orbwatch::app::simulation
