// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstddef>

#include "proc/optics/vec.h"

/// kLanes numbers, points or directions by component, for loops that compilers vectorize. NaN
/// replaces the nullopt of a scalar function.
namespace orbwatch::optics {

inline constexpr std::size_t kLanes = 32;
using Lanes = std::array<double, kLanes>;

struct Vec2Lanes {
  Lanes u;
  Lanes v;
};

struct Vec3Lanes {
  Lanes x;
  Lanes y;
  Lanes z;

  Vec3 at(std::size_t k) const { return {x[k], y[k], z[k]}; }
  void set(std::size_t k, const Vec3& a) {
    x[k] = a.x;
    y[k] = a.y;
    z[k] = a.z;
  }
};

}  // namespace orbwatch::optics
