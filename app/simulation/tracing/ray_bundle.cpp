// SPDX-License-Identifier: Apache-2.0
#include "app/simulation/tracing/ray_bundle.h"

namespace orbwatch::app::simulation {
namespace {

constexpr double kMargin = 1e-9;  // rounding, relative

}  // namespace

RayBundle::RayBundle(std::span<const Ray> rays) : empty_(rays.empty()) {
  if (empty_) return;
  Vec3 direction_sum;
  for (const Ray& ray : rays) {
    origin_.centre = origin_.centre + ray.origin;
    direction_sum = direction_sum + ray.direction;
  }
  origin_.centre = origin_.centre * (1 / static_cast<double>(rays.size()));
  const double length = norm(direction_sum);
  if (length > 0) axis_ = direction_sum * (1 / length);
  cosine_ = 1;
  for (const Ray& ray : rays) {
    origin_.radius = std::max(origin_.radius, norm(ray.origin - origin_.centre));
    cosine_ = std::min(cosine_, dot(ray.direction, axis_));
  }
  origin_.radius += kMargin * (1 + origin_.radius);
  cosine_ = std::max(cosine_ - kMargin, -1.0);
  sine_ = std::sqrt(1 - cosine_ * cosine_);
}

}  // namespace orbwatch::app::simulation
