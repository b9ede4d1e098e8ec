// SPDX-License-Identifier: Apache-2.0
#include "app/simulation/scene/nozzle.h"

#include <algorithm>
#include <cmath>

namespace orbwatch::app::simulation {
namespace {

/// Ray relative to the axis of revolution: horizontal parts, and height over the tip.
struct AxialRay {
  double x, y, z;
  double dx, dy, dz;
};

/// First distance at which the ray enters radius(z) = base + slope z between the heights z0 and z1:
/// the smaller positive root of |horizontal|^2 = radius^2 in that interval.
double lateral_entry(const AxialRay& ray, double base, double slope, double z0, double z1) {
  const double radius = base + slope * ray.z;
  const double growth = slope * ray.dz;
  const double a = ray.dx * ray.dx + ray.dy * ray.dy - growth * growth;
  const double b = ray.x * ray.dx + ray.y * ray.dy - radius * growth;
  const double c = ray.x * ray.x + ray.y * ray.y - radius * radius;
  const double discriminant = b * b - a * c;
  if (discriminant <= 0 || a == 0) return kNever;
  const double root = std::sqrt(discriminant);
  double nearest = kNever;
  for (const double distance : {(-b - root) / a, (-b + root) / a}) {
    const double height = ray.z + ray.dz * distance;
    if (distance > 0 && height >= z0 && height <= z1) nearest = std::min(nearest, distance);
  }
  return nearest;
}

double tip_entry(const AxialRay& ray, double radius) {
  if (ray.dz <= 0 || ray.z >= 0) return kNever;
  const double distance = -ray.z / ray.dz;
  const double x = ray.x + ray.dx * distance;
  const double y = ray.y + ray.dy * distance;
  return x * x + y * y <= radius * radius ? distance : kNever;
}

}  // namespace

Nozzle::Nozzle(const NozzleSettings& settings, const Vec3& tip, double ceiling)
    : tip_(tip),
      tip_radius_(settings.tip_radius),
      slope_((settings.column_radius - settings.tip_radius) / settings.cone_height),
      cone_cosine_(1 / std::sqrt(1 + slope_ * slope_)),
      cone_top_(tip.z + settings.cone_height),
      column_radius_(settings.column_radius),
      ceiling_(ceiling) {
  const double length = ceiling - tip.z;
  const double wanted = std::ceil(length / (2 * column_radius_));
  bound_count_ =
      static_cast<std::size_t>(std::clamp(wanted, 1.0, static_cast<double>(bounds_.size())));
  const double spacing = length / static_cast<double>(bound_count_);
  for (std::size_t i = 0; i < bound_count_; ++i) {
    const double height = (static_cast<double>(i) + 0.5) * spacing;
    bounds_[i] = {tip + Vec3{0, 0, height}, std::hypot(column_radius_, spacing / 2)};
  }
}

double Nozzle::entry(const Ray& ray) const {
  const Vec3 from_tip = ray.origin - tip_;
  const AxialRay axial{from_tip.x,      from_tip.y,      from_tip.z,
                       ray.direction.x, ray.direction.y, ray.direction.z};
  const double level = axial.dx * axial.dx + axial.dy * axial.dy;
  const double moment = axial.x * axial.dy - axial.y * axial.dx;
  if (moment * moment > column_radius_ * column_radius_ * level) return kNever;
  const double cone_height = cone_top_ - tip_.z;
  return std::min({tip_entry(axial, tip_radius_),
                   lateral_entry(axial, tip_radius_, slope_, 0, cone_height),
                   lateral_entry(axial, column_radius_, 0, cone_height, ceiling_ - tip_.z)});
}

Vec3 Nozzle::normal_at(const Vec3& point) const {
  constexpr double kOnTip = 1e-6;  // mm
  if (point.z - tip_.z < kOnTip) return {0, 0, -1};
  const double x = point.x - tip_.x;
  const double y = point.y - tip_.y;
  const double level = is_cone(point) ? cone_cosine_ : 1;
  const double scale = level / std::sqrt(x * x + y * y);
  return {x * scale, y * scale, is_cone(point) ? -slope_ * cone_cosine_ : 0};
}

}  // namespace orbwatch::app::simulation
