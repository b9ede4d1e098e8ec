// SPDX-License-Identifier: Apache-2.0
#include "proc/align/register/light/line_of_sight.h"

#include <algorithm>
#include <cmath>

namespace orbwatch::align {
namespace {

using optics::Vec3;

constexpr int kSteps = 3;                  // Gauss-Newton steps: lines bend little over closeness
constexpr double kNearestCloseness = 0.8;  // closeness; the ball's surface is 1
constexpr double kBeyond = -0.05;          // closeness: noise moves far things beyond infinity

/// The direction of a line's point from the ball's centre, and its derivative by closeness.
struct Course {
  Vec3 direction;
  Vec3 slope;
};

Course course(const LineOfSight& line, double closeness) {
  // closeness (origin + way direction) has length 1.
  const double along = dot(line.origin, line.direction);
  const double across2 = dot(line.origin, line.origin) - along * along;
  const double root = std::sqrt(1 - closeness * closeness * across2);
  return {line.origin * closeness + line.direction * (root - closeness * along),
          line.origin - line.direction * (along + closeness * across2 / root)};
}

}  // namespace

std::optional<LineOfSight> line_of_sight(const optics::BallProjection& ball,
                                         const optics::Vec2& pixel) {
  const auto ray = ball.ray(pixel);
  if (!ray) return std::nullopt;
  return LineOfSight{(ray->origin - ball.ball().centre) * (1 / ball.ball().radius), ray->direction};
}

Vec3 direction_at(const LineOfSight& line, double closeness) {
  return course(line, closeness).direction;
}

Meeting meeting(const LineOfSight& first, const LineOfSight& second, double sigma,
                const RoomCloseness& room) {
  const double weight = sigma * sigma / (room.spread * room.spread);
  double closeness = std::clamp(room.mean, kBeyond, kNearestCloseness);
  for (int step = 0;; ++step) {
    const Course a = course(first, closeness), b = course(second, closeness);
    const Meeting here{closeness, a.direction - b.direction, a.slope - b.slope};
    if (step == kSteps) return here;
    const double pull = dot(here.apart, here.slope) + weight * (closeness - room.mean);
    const double stiffness = dot(here.slope, here.slope) + weight;
    closeness = std::clamp(closeness - pull / stiffness, kBeyond, kNearestCloseness);
  }
}

}  // namespace orbwatch::align
