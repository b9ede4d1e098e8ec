// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cmath>
#include <numbers>

#include "proc/optics/vec.h"

namespace orbwatch::align {

/// The n-th of `count` directions that are even over the sphere (Fibonacci's spiral). Reentrant.
inline optics::Vec3 spiral(int n, int count) {
  const double z = 1 - (2 * n + 1.0) / count, across = std::sqrt(1 - z * z);
  const double longitude = n * std::numbers::pi * (3 - std::sqrt(5.0));
  return {across * std::cos(longitude), across * std::sin(longitude), z};
}

}  // namespace orbwatch::align
