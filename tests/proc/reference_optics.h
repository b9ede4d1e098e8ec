// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <optional>

#include "proc/optics/ball_projection.h"
#include "proc/optics/vec.h"

/// An independent implementation of the projection: the exact model by tracing rays to the ball and
/// reflecting vectors, or by the shortest path, with bisections in place of series and Newton; the
/// others by the paper's equations in its own axes. References for product code at its limit of
/// precision are in long double.
namespace orbwatch::tests {

using optics::Vec2;
using optics::Vec3;

/// The distance of things that are infinitely far away.
inline constexpr double kInfinity = std::numeric_limits<double>::infinity();

/// Unit reflection vector of the camera ray at angle `psi` from the axis, as angle from the facing
/// direction. Camera at (0, d) in the plane (across, along), ball of radius 1 at the origin.
inline double traced_phi(double psi, double d) {
  const Vec3 ray{std::sin(psi), -std::cos(psi), 0}, camera{0, d, 0};
  const double b = optics::dot(camera, ray);
  const double root = std::max(0.0, b * b - (d * d - 1));
  const Vec3 hit = camera + ray * (-b - std::sqrt(root));
  const Vec3 reflected = ray - hit * (2 * optics::dot(ray, hit));
  return std::atan2(reflected.x, reflected.y);
}

/// rho of the exact model; NaN in the blind cone. alpha in degrees.
inline double reference_exact_rho(double phi, double alpha) {
  if (alpha == 360) return std::sin(phi / 2);
  if (phi > alpha / 2 * std::numbers::pi / 180) return std::numeric_limits<double>::quiet_NaN();
  const double d = 1 / std::sin(alpha / 2 * std::numbers::pi / 180);
  double low = 0, high = std::asin(1 / d);
  const double limb = std::tan(high);
  for (int i = 0; i < 45; ++i) {
    const double middle = (low + high) / 2;
    (traced_phi(middle, d) < phi ? low : high) = middle;
  }
  return std::tan((low + high) / 2) / limb;
}

/// The paper's equation 6 and its classical form, for r = (-X, Z, Y).
inline std::optional<Vec2> paper_image(const Vec3& v, double stretch) {
  const Vec3 r{-v.x, v.z, v.y};
  const double scale = 1 / (std::sqrt(2 * (r.z + 1)) * stretch);
  const Vec2 image{r.x * scale, r.y * scale};
  if (!(std::hypot(image.u, image.v) <= 1)) return std::nullopt;
  return image;
}

struct ReferenceBall {
  optics::BallModel::Kind kind = optics::BallModel::Kind::Exact;
  double alpha = 360;
  optics::Outline outline;
  optics::Mat3 registration;

  /// The pixel of a direction in the reference frame.
  std::optional<Vec2> pixel(const Vec3& direction) const {
    const Vec3 v = optics::transposed(registration) * direction;
    std::optional<Vec2> image;  // right, up; unit disc
    if (kind == optics::BallModel::Kind::Exact) {
      const double across = std::hypot(v.x, v.z);
      const double rho = reference_exact_rho(std::atan2(across, v.y), alpha);
      if (std::isnan(rho)) return std::nullopt;
      image = across > 0 ? Vec2{-v.x / across * rho, v.z / across * rho} : Vec2{};
    } else {
      const bool paper = kind == optics::BallModel::Kind::Paper;
      image = paper_image(v, paper ? std::sin(alpha / 4 * std::numbers::pi / 180) : 1);
      if (!image) return std::nullopt;
    }
    // Turn into the ellipse's axes, stretch, turn back.
    const double angle = outline.angle * std::numbers::pi / 180;
    const double c = std::cos(angle), s = std::sin(angle);
    const double right = image->u, down = -image->v;
    const double along = (right * c + down * s) * outline.rx;
    const double across = (-right * s + down * c) * outline.ry;
    return Vec2{outline.centre.u + along * c - across * s,
                outline.centre.v + along * s + across * c};
  }
};

using Real = long double;

struct RealVec3 {
  Real x = 0, y = 0, z = 0;

  RealVec3() = default;
  RealVec3(Real x_value, Real y_value, Real z_value) : x(x_value), y(y_value), z(z_value) {}
  explicit RealVec3(const Vec3& v) : x(v.x), y(v.y), z(v.z) {}

  friend RealVec3 operator+(const RealVec3& a, const RealVec3& b) {
    return {a.x + b.x, a.y + b.y, a.z + b.z};
  }
  friend RealVec3 operator-(const RealVec3& a, const RealVec3& b) {
    return {a.x - b.x, a.y - b.y, a.z - b.z};
  }
  friend RealVec3 operator*(const RealVec3& a, Real s) { return {a.x * s, a.y * s, a.z * s}; }
};

inline Real dot(const RealVec3& a, const RealVec3& b) { return a.x * b.x + a.y * b.y + a.z * b.z; }
inline RealVec3 cross(const RealVec3& a, const RealVec3& b) {
  return {a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x};
}
inline Real norm(const RealVec3& a) { return std::sqrt(dot(a, a)); }
inline RealVec3 normalized(const RealVec3& a) { return a * (1 / norm(a)); }
inline Vec3 rounded(const RealVec3& v) {
  return {static_cast<double>(v.x), static_cast<double>(v.y), static_cast<double>(v.z)};
}
/// Degrees between two directions.
inline double deviation(const RealVec3& a, const RealVec3& b) {
  return static_cast<double>(std::atan2(norm(cross(a, b)), dot(a, b)) * 180 /
                             std::numbers::pi_v<Real>);
}

struct RealRay {
  RealVec3 origin;
  RealVec3 direction;
};

/// The ray that leaves the unit ball at the origin where `ray`, of unit direction, first meets it.
inline std::optional<RealRay> reflected(const RealRay& ray) {
  const Real along = dot(ray.origin, ray.direction);
  const Real root = along * along - (dot(ray.origin, ray.origin) - 1);
  if (!(root >= 0 && along < 0)) return std::nullopt;
  const RealVec3 hit = ray.origin + ray.direction * (-along - std::sqrt(root));
  return RealRay{hit, ray.direction - hit * (2 * dot(ray.direction, hit))};
}

/// A point in that direction from the ball's centre; far away when the distance is infinite.
struct ScenePoint {
  RealVec3 direction;
  Real distance = std::numeric_limits<Real>::infinity();
};

/// Direction in which a camera at `camera` sees a point mirrored in the unit ball at the origin, by
/// Fermat's principle: over the arc that both see, the path camera - ball - point is convex, and
/// its slope is bisected. nullopt when there is no such arc, or when the camera sees the point
/// straight along the axis.
inline std::optional<RealVec3> fermat_ray(const RealVec3& camera, const ScenePoint& point) {
  const RealVec3 facing = normalized(camera);
  const RealVec3 across = point.direction - facing * dot(point.direction, facing);
  if (norm(across) == 0) return std::nullopt;
  const RealVec3 aside = normalized(across);
  const Real phi = std::atan2(norm(across), dot(point.direction, facing));
  Real low = std::max(Real{0}, phi - std::acos(1 / point.distance));
  Real high = std::min(phi, std::acos(1 / norm(camera)));
  if (!(low <= high)) return std::nullopt;
  RealVec3 hit;
  for (int i = 0; i < 70; ++i) {
    const Real t = (low + high) / 2;
    hit = facing * std::cos(t) + aside * std::sin(t);
    const RealVec3 tangent = aside * std::cos(t) - facing * std::sin(t);
    const bool far = std::isinf(point.distance);
    const RealVec3 to_point =
        far ? point.direction : normalized(point.direction * point.distance - hit);
    const bool shorter_ahead = dot(normalized(camera - hit) + to_point, tangent) > 0;
    (shorter_ahead ? low : high) = t;
  }
  return normalized(hit - camera);
}

/// The exit ray of a ray of unit direction from a plane of glass, traced surface by surface.
/// `normal` points in the direction of the light; the glass begins at `depth` along it.
inline RealRay through_glass(const RealRay& ray, const RealVec3& normal, Real depth, Real thickness,
                             Real index) {
  const auto to_plane = [&](const RealRay& r, Real offset) {
    return r.origin + r.direction * ((offset - dot(r.origin, normal)) / dot(r.direction, normal));
  };
  const auto refracted = [&](const RealVec3& direction, Real ratio) {
    const RealVec3 along = (direction - normal * dot(direction, normal)) * ratio;
    return along + normal * std::sqrt(1 - dot(along, along));
  };
  const RealRay within{to_plane(ray, depth), refracted(ray.direction, 1 / index)};
  return {to_plane(within, depth + thickness), refracted(within.direction, index)};
}

}  // namespace orbwatch::tests
