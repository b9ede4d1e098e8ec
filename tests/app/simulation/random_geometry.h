// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <random>

#include "app/simulation/tracing/ray.h"

namespace orbwatch::app::simulation {

/// Random points and directions; the same ones in every run.
class RandomGeometry {
 public:
  double number(double lo, double hi) {
    return std::uniform_real_distribution<double>(lo, hi)(engine_);
  }
  Vec3 point(const Box& box) {
    return {number(box.lo.x, box.hi.x), number(box.lo.y, box.hi.y), number(box.lo.z, box.hi.z)};
  }
  Vec3 direction() {
    for (;;) {
      const Vec3 v = point({{-1, -1, -1}, {1, 1, 1}});
      if (const double length = norm(v); length > 0.1 && length < 1) return v * (1 / length);
    }
  }
  Ray ray(const Box& from) { return {point(from), direction()}; }

 private:
  std::mt19937_64 engine_{20240607};
};

}  // namespace orbwatch::app::simulation
