// SPDX-License-Identifier: Apache-2.0
#include "proc/optics/resolution.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "proc/optics/vec.h"

namespace orbwatch::optics {
namespace {

// Step in radians: far below a pixel, far above the rounding of a difference.
constexpr double kStep = 1e-5;

/// Pixels per radian when the direction moves along `tangent` on the surface that lies there, also
/// beyond its edges; one-sided where the blind cone begins on the other side. nullopt when it
/// begins on both.
std::optional<Vec2> derivative(const BallProjection& ball, const Vec3& direction,
                               const Vec2& centre, const Vec3& tangent) {
  const double closeness = ball.proxy().hit(direction).closeness;
  const auto beside = [&](double step) {
    return ball.pixel(normalized(direction + tangent * step), closeness);
  };
  const auto ahead = beside(kStep), behind = beside(-kStep);
  if (!ahead && !behind) return std::nullopt;
  const double span = ahead && behind ? 2 * kStep : kStep;
  const Vec2 to = ahead.value_or(centre), from = behind.value_or(centre);
  return Vec2{(to.u - from.u) / span, (to.v - from.v) / span};
}

/// Unit vectors perpendicular to `direction` and to each other: one around the axis of the ball's
/// picture, for which the limb is equally near on either side, and one away from it.
std::pair<Vec3, Vec3> tangents(const Vec3& direction, const Vec3& axis) {
  const Vec3 around = cross(direction, axis);
  const Vec3 aside = std::abs(direction.z) < 0.7 ? Vec3{0, 0, 1} : Vec3{1, 0, 0};
  constexpr double kOnAxis = 1e-6;
  const Vec3 first = normalized(norm(around) > kOnAxis ? around : cross(direction, aside));
  return {first, cross(direction, first)};
}

/// The smaller singular value of the 2x2 matrix with these columns.
double smaller_singular_value(const Vec2& a, const Vec2& b) {
  const double sum = a.u * a.u + a.v * a.v + b.u * b.u + b.v * b.v;
  const double determinant = a.u * b.v - a.v * b.u;
  const double larger =
      std::sqrt((sum + std::sqrt(std::max(0.0, sum * sum - 4 * determinant * determinant))) / 2);
  return larger > 0 ? std::abs(determinant) / larger : 0;
}

double resolution_at(const BallProjection& ball, const Vec3& direction, const Vec2& pixel) {
  const auto [first, second] = tangents(direction, ball.facing());
  const auto a = derivative(ball, direction, pixel, first);
  const auto b = derivative(ball, direction, pixel, second);
  return a && b ? smaller_singular_value(*a, *b) / degrees(1) : 0;
}

bool inside(const Vec2& pixel, int width, int height) {
  return pixel.u >= -0.5 && pixel.u <= width - 0.5 && pixel.v >= -0.5 && pixel.v <= height - 0.5;
}

}  // namespace

double resolution(const BallProjection& ball, const Vec3& direction) {
  const auto pixel = ball.pixel(direction);
  return pixel ? resolution_at(ball, direction, *pixel) : 0;
}

std::vector<float> resolution_map(const ViewProjection& view, const BallProjection& ball,
                                  int source_width, int source_height) {
  std::vector<float> map;
  map.reserve(static_cast<std::size_t>(view.width()) * static_cast<std::size_t>(view.height()));
  for (int y = 0; y < view.height(); ++y) {
    for (int x = 0; x < view.width(); ++x) {
      const auto direction = view.direction(x, y);
      const auto pixel = direction ? ball.pixel(*direction) : std::nullopt;
      const bool seen = pixel && inside(*pixel, source_width, source_height);
      map.push_back(seen ? static_cast<float>(resolution_at(ball, *direction, *pixel)) : 0.0F);
    }
  }
  return map;
}

}  // namespace orbwatch::optics
