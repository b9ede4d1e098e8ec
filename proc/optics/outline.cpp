// SPDX-License-Identifier: Apache-2.0
#include "proc/optics/outline.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <numeric>
#include <optional>
#include <string>

namespace orbwatch::optics {
namespace {

constexpr int kSamples = 64;  // samples of the limb; five would determine it

/// Angle of a sample on a circle, radians.
double sample_angle(int sample) { return 2 * std::numbers::pi * sample / kSamples; }

/// Two unit vectors that make a right-handed frame with the unit vector `axis`. The first one lies
/// in a plane with the camera's z axis: the limb's farthest points lie in its direction and
/// opposite.
std::array<Vec3, 2> across(const Vec3& axis) {
  const Vec3 beside = cross(axis, {0, 0, 1});
  const Vec3 second = norm(beside) > 1e-12 ? normalized(beside) : Vec3{0, 1, 0};
  return {cross(second, axis), second};
}

/// Solves m x = right_side.
Vec3 solve(const Mat3& m, const Vec3& right_side) {
  const Vec3 c0 = cross(m.row1, m.row2), c1 = cross(m.row2, m.row0), c2 = cross(m.row0, m.row1);
  return (c0 * right_side.x + c1 * right_side.y + c2 * right_side.z) * (1 / dot(m.row0, c0));
}

using Rays = std::array<Vec3, kSamples>;

/// The axis of the cone that fits the unit vectors `rays` best: w . x = 1 by least squares.
/// Coordinates along and across the mean ray, the latter in units of the cone's width: a narrow
/// cone's equations would lose digits otherwise.
Vec3 cone_axis(const Rays& rays) {
  Vec3 sum;
  for (const Vec3& ray : rays) sum = sum + ray;
  const Vec3 mean = normalized(sum);
  const auto [first, second] = across(mean);
  double width = 0;
  for (const Vec3& ray : rays) width = std::max(width, norm(ray - mean));
  Mat3 normal{{}, {}, {}};
  Vec3 right_side;
  for (const Vec3& ray : rays) {
    const Vec3 w{dot(ray, first) / width, dot(ray, second) / width, dot(ray, mean)};
    normal.row0 = normal.row0 + w * w.x;
    normal.row1 = normal.row1 + w * w.y;
    normal.row2 = normal.row2 + w * w.z;
    right_side = right_side + w;
  }
  const Vec3 x = solve(normal, right_side);
  return normalized(first * (x.x / width) + second * (x.y / width) + mean * x.z);
}

/// The ball's centre for which the limb's rays, displaced by a window, touch the unit sphere around
/// it. Newton's method on the squared distances of the rays from the centre, from a first guess.
Vec3 behind_window(Vec3 centre, const Rays& rays, const Window& window) {
  for (int step = 0; step < 20; ++step) {
    Mat3 normal{{}, {}, {}};
    Vec3 right_side;
    for (const Vec3& ray : rays) {
      const Vec3 towards = centre - displacement(window, ray);
      const Vec3 foot = towards - ray * dot(ray, towards);  // also half the derivative
      normal.row0 = normal.row0 + foot * foot.x;
      normal.row1 = normal.row1 + foot * foot.y;
      normal.row2 = normal.row2 + foot * foot.z;
      right_side = right_side + foot * ((1 - dot(foot, foot)) / 2);
    }
    const Vec3 move = solve(normal, right_side);
    centre = centre + move;
    if (norm(move) < 1e-12 * norm(centre)) break;
  }
  return centre;
}

/// The ray, where it leaves the camera, that touches the ball at an angle around the axis. A window
/// displaces the cone's tip separately for each ray, by little: a few iterations converge.
Vec3 limb_ray(const BallSight& sight, const Window& window, double angle) {
  const auto [first, second] = across(sight.axis);
  const Vec3 side = first * std::cos(angle) + second * std::sin(angle);
  Vec3 towards = sight.axis * sight.distance;
  Vec3 ray;
  for (int step = 0; step < (window.thickness > 0 ? 20 : 1); ++step) {
    const double sin_limb = 1 / norm(towards), cos_limb = std::sqrt(1 - sin_limb * sin_limb);
    const Vec3 axis = towards * sin_limb;
    ray = axis * cos_limb + normalized(side - axis * dot(axis, side)) * sin_limb;
    towards = sight.axis * sight.distance - displacement(window, ray);
  }
  return ray;
}

/// Solves the equations whose last column is the right side; Gauss' elimination.
template <std::size_t N>
std::array<double, N> solve(std::array<std::array<double, N + 1>, N> rows) {
  for (std::size_t i = 0; i < N; ++i) {
    const auto pivot = std::max_element(rows.begin() + i, rows.end(), [i](auto& a, auto& b) {
      return std::abs(a[i]) < std::abs(b[i]);
    });
    std::swap(rows[i], *pivot);
    for (std::size_t r = 0; r < N; ++r) {
      if (r == i) continue;
      const double factor = rows[r][i] / rows[i][i];
      for (std::size_t c = i; c <= N; ++c) rows[r][c] -= factor * rows[i][c];
    }
  }
  std::array<double, N> x;
  for (std::size_t i = 0; i < N; ++i) x[i] = rows[i][N] / rows[i][i];
  return x;
}

/// The ellipse a u^2 + b uv + c v^2 + d u + e v = 1 as an Outline; nullopt when it is a parabola or
/// hyperbola.
std::optional<Outline> ellipse(const std::array<double, 5>& conic) {
  const auto [a, b, c, d, e] = conic;
  const double discriminant = 4 * a * c - b * b;
  if (!(discriminant > 0)) return std::nullopt;
  const Vec2 centre{(b * e - 2 * c * d) / discriminant, (b * d - 2 * a * e) / discriminant};
  const double size = 1 + (a * centre.u + b * centre.v) * centre.u + c * centre.v * centre.v;
  // Half the sum and half the difference of the matrix' eigenvalues.
  const double mean = (a + c) / 2 / size, half = std::hypot(a - c, b) / 2 / size;
  if (!(mean > half)) return std::nullopt;
  // The long axis belongs to the small eigenvalue.
  const double angle = std::atan2(-b / size, (c - a) / size) / 2;
  return Outline{centre, 1 / std::sqrt(mean - half), 1 / std::sqrt(mean + half), degrees(angle)};
}

/// Fits the best ellipse to the points; about their centre and in units of their spread, so that
/// the equations are well conditioned.
std::optional<Outline> fit_ellipse(const std::array<Vec2, kSamples>& points) {
  Vec2 mean;
  for (const Vec2& p : points) mean = {mean.u + p.u / kSamples, mean.v + p.v / kSamples};
  double spread = 0;
  for (const Vec2& p : points) spread = std::max(spread, std::hypot(p.u - mean.u, p.v - mean.v));
  std::array<std::array<double, 6>, 5> equations{};
  for (const Vec2& p : points) {
    const double u = (p.u - mean.u) / spread, v = (p.v - mean.v) / spread;
    const std::array<double, 6> terms{u * u, u * v, v * v, u, v, 1};
    for (std::size_t r = 0; r < 5; ++r) {
      for (std::size_t c = 0; c < 6; ++c) equations[r][c] += terms[r] * terms[c];
    }
  }
  auto outline = ellipse(solve(equations));
  if (!outline) return std::nullopt;
  outline->centre = {mean.u + outline->centre.u * spread, mean.v + outline->centre.v * spread};
  outline->rx *= spread;
  outline->ry *= spread;
  return outline;
}

}  // namespace

double relative_distance(const Outline& outline, const Vec2& pixel) {
  const double angle = radians(outline.angle), c = std::cos(angle), s = std::sin(angle);
  const double du = pixel.u - outline.centre.u, dv = pixel.v - outline.centre.v;
  return std::hypot((du * c + dv * s) / outline.rx, (dv * c - du * s) / outline.ry);
}

Result<> check_ellipse(const Outline& outline) {
  if (!std::isfinite(outline.centre.u) || !std::isfinite(outline.centre.v) ||
      !std::isfinite(outline.angle)) {
    return fail("the ball's centre and angle must be finite numbers");
  }
  if (!(outline.rx > 0) || !(outline.ry > 0) || !std::isfinite(outline.rx + outline.ry)) {
    return fail("the ball's radius must be above 0 pixels");
  }
  return {};
}

Result<> check_outline(const Outline& outline, int picture_width, int picture_height) {
  const Vec2& c = outline.centre;
  if (c.u >= -0.5 && c.u <= picture_width - 0.5 && c.v >= -0.5 && c.v <= picture_height - 0.5) {
    return {};
  }
  return fail("the ball's centre (" + std::to_string(c.u) + ", " + std::to_string(c.v) +
              ") is outside of the picture, which is " + std::to_string(picture_width) + "x" +
              std::to_string(picture_height));
}

Result<BallSight> sight_from_outline(const Outline& outline, const Lens& lens,
                                     const Window& window) {
  if (auto checked = check_ellipse(outline); !checked) return tl::unexpected(checked.error());
  const double c = std::cos(radians(outline.angle)), s = std::sin(radians(outline.angle));
  Rays rays;
  for (int i = 0; i < kSamples; ++i) {
    const double along = outline.rx * std::cos(sample_angle(i));
    const double beside = outline.ry * std::sin(sample_angle(i));
    const auto ray = lens.direction(
        {outline.centre.u + along * c - beside * s, outline.centre.v + along * s + beside * c});
    if (!ray) return fail("a part of the ball's limb lies where the lens shows nothing");
    rays[i] = *ray;
  }
  const Vec3 axis = cone_axis(rays);
  std::array<double, kSamples> angles;
  std::transform(rays.begin(), rays.end(), angles.begin(),
                 [&](const Vec3& ray) { return angle_between(ray, axis); });
  const double aperture = std::accumulate(angles.begin(), angles.end(), 0.0) / kSamples;
  const auto [least, most] = std::minmax_element(angles.begin(), angles.end());
  const double deviation = std::max(aperture - *least, *most - aperture);
  if (!(deviation <= 0.05 * aperture) || !(aperture < std::numbers::pi / 2)) {
    return fail("the outline is not that of a ball: a ball's limb stands on a circular cone");
  }
  const BallSight sight{axis, 1 / std::sin(aperture)};
  if (!(window.thickness > 0)) return sight;
  const Vec3 centre = behind_window(axis * sight.distance, rays, window);
  const double distance = norm(centre);
  if (!(distance > 1)) return fail("the ball's limb fits no ball behind that window");
  return BallSight{centre * (1 / distance), distance};
}

Result<Outline> outline_from_sight(const BallSight& sight, const Lens& lens, const Window& window) {
  if (!(sight.distance > 1) || !std::isfinite(sight.distance)) {
    return fail("the distance is " + std::to_string(sight.distance) +
                " ball radii; it must be above 1: the camera stands outside the ball");
  }
  std::array<Vec2, kSamples> pixels;
  for (int i = 0; i < kSamples; ++i) {
    const auto pixel = lens.pixel(limb_ray(sight, window, sample_angle(i)));
    if (!pixel) return fail("the lens does not show the whole limb of the ball");
    pixels[i] = *pixel;
  }
  const auto outline = fit_ellipse(pixels);
  if (!outline) return fail("the ball's limb is not an ellipse in the picture");
  return *outline;
}

}  // namespace orbwatch::optics
