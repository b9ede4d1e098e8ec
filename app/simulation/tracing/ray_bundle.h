// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <span>

#include "app/simulation/tracing/ray.h"

namespace orbwatch::app::simulation {

/// Bounds for a set of rays, which start in a sphere and point into a cone, for fast and
/// conservative intersection tests with small bodies. Reentrant.
class RayBundle {
 public:
  /// An empty bundle.
  RayBundle() = default;
  /// Bundle around `rays`.
  explicit RayBundle(std::span<const Ray> rays);

  /// False only if no ray of the bundle hits the sphere.
  bool may_meet(const Sphere& body) const {
    if (empty_) return false;
    const Vec3 away = body.centre - origin_.centre;
    const double along = dot(away, axis_);
    const double across = std::sqrt(std::max(0.0, dot(away, away) - along * along));
    // Signed distance of the centre from the cone's mantle; behind the tip it is too small.
    return across * cosine_ - along * sine_ <= body.radius + origin_.radius;
  }

 private:
  bool empty_ = true;
  Sphere origin_;
  Vec3 axis_{0, 0, 1};
  double cosine_ = -1;  ///< cosine of half the cone's opening, 0 to 180 degrees
  double sine_ = 0;
};

}  // namespace orbwatch::app::simulation
