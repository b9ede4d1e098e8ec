#pragma once

#include <cmath>
#include <limits>
#include <numbers>
#include <optional>

#include "proc/optics/ball_projection.h"
#include "proc/optics/vec.h"

/// The projection once more, in double precision and by other means: the exact model by tracing
/// camera rays to the ball and reflecting vectors, with a bisection in place of closed form and
/// Newton; the others by the paper's equations in its own axes.
namespace orbwatch::tests {

using optics::Vec2;
using optics::Vec3;

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

}  // namespace orbwatch::tests
