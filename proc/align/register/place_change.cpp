// SPDX-License-Identifier: Apache-2.0
#include "proc/align/register/place_change.h"

#include <cmath>

#include "proc/align/rotation_fit.h"

namespace orbwatch::align {
namespace {

using optics::BallProjection;
using optics::Outline;
using optics::Vec2;
using optics::Vec3;

constexpr double kPlaceStep = 1e-5;  // radians to either side

/// Pixels per radian between two views of a direction.
std::optional<Vec2> pixel_slope(const std::optional<Vec2>& low, const std::optional<Vec2>& high) {
  if (!low || !high) return std::nullopt;
  return Vec2{(high->u - low->u) / (2 * kPlaceStep), (high->v - low->v) / (2 * kPlaceStep)};
}

double area(const Vec2& a, const Vec2& b) { return a.u * b.v - a.v * b.u; }

}  // namespace

Outline changed(const Outline& outline, double u, double v, double radius) {
  const double unit = optics::mean_radius(outline);
  return {{outline.centre.u + u * unit, outline.centre.v + v * unit},
          outline.rx * (1 + radius),
          outline.ry * (1 + radius),
          outline.angle};
}

Place changed(const Place& place, const PlaceChange& by) {
  return {rotation_about({by[0], by[1], by[2]}) * place.rotation,
          changed(place.outline, by[3] / 2, by[4] / 2, by[5] / 2)};
}

PlaceChange outline_change(const Outline& from, const Outline& to) {
  const double unit = optics::mean_radius(from) / 2;
  return {0,
          0,
          0,
          (to.centre.u - from.centre.u) / unit,
          (to.centre.v - from.centre.v) / unit,
          (optics::mean_radius(to) - optics::mean_radius(from)) / unit};
}

Result<PlaceShifts> PlaceShifts::make(const SoughtCamera& sought, const Place& place) {
  std::vector<Place> places{place};
  for (int n = 0; n < kPlaceUnknowns; ++n) {
    for (const double step : {-kPlaceStep, kPlaceStep}) {
      PlaceChange by;
      by[n] = step;
      places.push_back(changed(place, by));
    }
  }
  std::vector<BallProjection> balls;
  for (const Place& one : places) {
    const auto ball = turned(sought, one.rotation, one.outline);
    if (!ball) return tl::unexpected(ball.error());
    balls.push_back(*ball);
  }
  return PlaceShifts(std::move(balls));
}

std::optional<PlaceShifts::Shifts> PlaceShifts::at(const Vec3& direction) const {
  const BallProjection& ball = balls_.front();
  const double closeness = ball.proxy().hit(direction).closeness;
  const Vec3 aside = std::abs(direction.z) < 0.7 ? Vec3{0, 0, 1} : Vec3{1, 0, 0};
  const Vec3 along = optics::normalized(cross(direction, aside)), across = cross(direction, along);
  const auto beside = [&](const Vec3& way) {
    const Vec3 low = direction - way * kPlaceStep, high = direction + way * kPlaceStep;
    return pixel_slope(ball.pixel(optics::normalized(low), closeness),
                       ball.pixel(optics::normalized(high), closeness));
  };
  const auto a = beside(along), b = beside(across);
  if (!a || !b) return std::nullopt;
  Shifts shifts;
  for (std::size_t n = 0; n < shifts.size(); ++n) {
    const auto p = pixel_slope(balls_[2 * n + 1].pixel(direction, closeness),
                               balls_[2 * n + 2].pixel(direction, closeness));
    if (!p) return std::nullopt;
    shifts[n] = along * (area(*p, *b) / area(*a, *b)) + across * (area(*a, *p) / area(*a, *b));
  }
  return shifts;
}

}  // namespace orbwatch::align
