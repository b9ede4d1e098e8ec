// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "proc/optics/vec.h"

namespace orbwatch::app::simulation {

using optics::Vec3;

/// Distance to an object that a ray misses.
inline constexpr double kNever = std::numeric_limits<double>::infinity();

/// Half-line in the machine frame, mm. Everything in this file is reentrant.
struct Ray {
  Vec3 origin;
  Vec3 direction;  ///< unit length

  Vec3 at(double distance) const { return origin + direction * distance; }
};

struct Sphere {
  Vec3 centre;
  double radius = 0;
};

/// Axis-aligned box.
struct Box {
  Vec3 lo;
  Vec3 hi;

  bool contains(const Vec3& p) const {
    return p.x >= lo.x && p.x <= hi.x && p.y >= lo.y && p.y <= hi.y && p.z >= lo.z && p.z <= hi.z;
  }
};

/// Intersection of a ray with a face of a box.
struct FaceHit {
  double distance = kNever;
  int axis = 0;  ///< axis of the face's normal: 0 X, 1 Y, 2 Z
};

/// Distance at which a ray from outside enters the sphere; kNever when it misses, points away or
/// starts inside.
inline double entry(const Ray& ray, const Sphere& sphere) {
  const Vec3 from_centre = ray.origin - sphere.centre;
  const double b = dot(from_centre, ray.direction);
  const double c = dot(from_centre, from_centre) - sphere.radius * sphere.radius;
  const double discriminant = b * b - c;
  if (b >= 0 || c <= 0 || discriminant <= 0) return kNever;
  return -b - std::sqrt(discriminant);
}

/// Entry and exit of a ray through a box, by the slab method.
struct BoxPassage {
  FaceHit in{-kNever, 0};
  FaceHit out{kNever, 0};

  bool misses() const { return out.distance < std::max(in.distance, 0.0); }
};

inline BoxPassage passage(const Ray& ray, const Box& box) {
  const std::array origin{ray.origin.x, ray.origin.y, ray.origin.z};
  const std::array direction{ray.direction.x, ray.direction.y, ray.direction.z};
  const std::array lo{box.lo.x, box.lo.y, box.lo.z};
  const std::array hi{box.hi.x, box.hi.y, box.hi.z};
  BoxPassage result;
  for (std::size_t axis = 0; axis < 3; ++axis) {
    const double inverse = 1 / direction[axis];
    const double to_lo = (lo[axis] - origin[axis]) * inverse;
    const double to_hi = (hi[axis] - origin[axis]) * inverse;
    const double near = std::min(to_lo, to_hi);
    const double far = std::max(to_lo, to_hi);
    if (near > result.in.distance) result.in = {near, static_cast<int>(axis)};
    if (far < result.out.distance) result.out = {far, static_cast<int>(axis)};
  }
  return result;
}

/// Entry of a ray from outside into a solid box.
inline FaceHit entry(const Ray& ray, const Box& box) {
  const BoxPassage through = passage(ray, box);
  return through.misses() || through.in.distance < 0 ? FaceHit{} : through.in;
}

/// Intersection of a ray with the walls of a hollow box, which are visible from the inside only: a
/// ray from outside passes the first wall like a window.
inline FaceHit exit(const Ray& ray, const Box& box) {
  const BoxPassage through = passage(ray, box);
  return through.misses() ? FaceHit{} : through.out;
}

}  // namespace orbwatch::app::simulation
