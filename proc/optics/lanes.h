#pragma once

#include <array>
#include <cstddef>

#include "proc/optics/vec.h"

/// So many numbers, points or directions at once, by component: loops over them become vector code.
/// What a function for one of them returns as nothing is not a number here.
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
