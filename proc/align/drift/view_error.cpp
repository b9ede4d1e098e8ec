// SPDX-License-Identifier: Apache-2.0
#include "proc/align/drift/view_error.h"

#include <cmath>
#include <numbers>

namespace orbwatch::align {
namespace {

using optics::BallProjection;
using optics::Outline;
using optics::Vec3;

constexpr int kDirections = 400;
/// Share of the radius by which the motion is varied for the linear part.
constexpr double kDifferenceStep = 1e-4;

/// Directions spread evenly up to kSeen from `facing` (Fibonacci's lattice).
std::vector<Vec3> seen_directions(const Vec3& facing) {
  const Vec3 other = std::abs(facing.z) < 0.9 ? Vec3{0, 0, 1} : Vec3{1, 0, 0};
  const Vec3 side = normalized(cross(facing, other)), up = cross(side, facing);
  const double lowest = std::cos(optics::radians(ViewError::kSeen));
  std::vector<Vec3> directions;
  for (int i = 0; i < kDirections; ++i) {
    const double along = std::lerp(1.0, lowest, (i + 0.5) / kDirections);
    const double across = std::sqrt(1 - along * along);
    const double turn = 2 * std::numbers::pi * std::numbers::phi * i;
    directions.push_back(facing * along + side * (across * std::cos(turn)) +
                         up * (across * std::sin(turn)));
  }
  return directions;
}

PictureMotion unit_motion(int component, double size, double radius) {
  PictureMotion motion;
  if (component == 0) motion.u = size * radius;
  if (component == 1) motion.v = size * radius;
  if (component == 2) motion.growth = size;
  if (component == 3) motion.roll = size;
  return motion;
}

}  // namespace

ViewError::ViewError(const BallProjection& projection, const Outline& outline)
    : projection_(projection), outline_(outline) {
  for (const Vec3& direction : seen_directions(projection.facing())) {
    const auto pixel = projection.pixel(direction, 0);
    const auto ray = pixel ? projection.ray(*pixel) : std::nullopt;
    if (ray) seen_.push_back({*pixel, ray->direction});
  }
  const double radius = optics::mean_radius(outline);
  int count = 0;
  for (const Seen& seen : seen_) {
    std::array<Vec3, 4> slopes;
    bool is_whole = true;
    for (int k = 0; k < 4; ++k) {
      const auto back = unit_motion(k, -kDifferenceStep, radius),
                 forth = unit_motion(k, kDifferenceStep, radius);
      const auto a = projection.ray(before(back, outline, seen.pixel));
      const auto b = projection.ray(before(forth, outline, seen.pixel));
      is_whole = is_whole && a && b;
      if (!is_whole) break;
      const double unit = k < 2 ? kDifferenceStep * radius : kDifferenceStep;
      slopes[static_cast<std::size_t>(k)] = (b->direction - a->direction) * (0.5 / unit);
    }
    if (!is_whole) continue;
    ++count;
    for (int i = 0; i < 4; ++i) {
      for (int j = 0; j < 4; ++j) {
        square_(i, j) +=
            dot(slopes[static_cast<std::size_t>(i)], slopes[static_cast<std::size_t>(j)]);
      }
    }
  }
  const double degree = optics::degrees(1);
  if (count > 0) square_ *= degree * degree / count;
}

double ViewError::small(const PictureMotion& motion) const {
  const cv::Vec4d m(motion.u, motion.v, motion.growth, motion.roll);
  return std::sqrt(std::max(0.0, m.dot(square_ * m)));
}

double ViewError::exact(const PictureMotion& motion) const {
  double sum = 0;
  int count = 0;
  for (const Seen& seen : seen_) {
    const auto ray = projection_.ray(before(motion, outline_, seen.pixel));
    if (!ray) continue;
    const double angle = angle_between(ray->direction, seen.direction);
    sum += angle * angle;
    ++count;
  }
  return count > 0 ? optics::degrees(std::sqrt(sum / count)) : 180;
}

}  // namespace orbwatch::align
