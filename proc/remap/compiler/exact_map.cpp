// SPDX-License-Identifier: Apache-2.0
#include "proc/remap/compiler/exact_map.h"

#include <cmath>

namespace orbwatch::remap {
namespace {

using optics::kLanes;

// Range of coordinates, px; a ball far larger than the picture could exceed the fixed point's.
constexpr double kRange = 1 << (30 - kFractionBits);

// Rounds half away from zero like std::lround, which is a call.
std::int32_t fixed(double pixels) {
  const double scaled = pixels * (1 << kFractionBits);
  return static_cast<std::int32_t>(scaled + (scaled < 0 ? -0.5 : 0.5));
}

}  // namespace

Coordinate ExactMap::coordinate(const optics::Vec3& direction, double closeness) const {
  const auto pixel = ball_.pixel(direction, closeness);
  if (!pixel) return {kBlind, 0};
  const bool fits = std::abs(pixel->u) <= kRange && std::abs(pixel->v) <= kRange;
  return fits ? Coordinate{fixed(pixel->u), fixed(pixel->v)} : Coordinate{kOutside, 0};
}

void ExactMap::coordinates(const optics::Vec3Lanes& directions, const optics::Lanes& closeness,
                           CoordinateLanes& out) const {
  optics::Vec2Lanes pixels;
  ball_.pixels(directions, closeness, pixels);
  for (std::size_t k = 0; k < kLanes; ++k) {
    const double u = pixels.u[k], v = pixels.v[k];
    const bool fits = (std::abs(u) <= kRange) & (std::abs(v) <= kRange);
    out.u[k] = fixed(fits ? u : 0);
    out.v[k] = fixed(fits ? v : 0);
    pixels.v[k] = fits ? 1 : 0;
  }
  for (std::size_t k = 0; k < kLanes; ++k) {
    if (pixels.v[k] == 0) out.u[k] = std::isnan(pixels.u[k]) ? kBlind : kOutside;
  }
}

void ExactMap::evaluate(const optics::Vec2Lanes& pixels, MapLanes& out) const {
  optics::Vec3Lanes directions;
  view_.directions(pixels, directions);
  optics::Lanes closeness;
  const bool far = ball_.proxy().is_far();
  for (std::size_t k = 0; k < kLanes; ++k) {
    const optics::Vec3 direction = directions.at(k);
    const bool ends = std::isnan(direction.x);
    const auto hit = far || ends ? optics::SceneProxy::Hit{} : ball_.proxy().hit(direction);
    closeness[k] = hit.closeness;
    out.surfaces[k] = ends ? kNoSurface : hit.surface;
  }
  coordinates(directions, closeness, out.coordinates);
}

int ExactMap::surface(int x, int y) const {
  const auto direction = view_.direction(x, y);
  return direction ? ball_.proxy().hit(*direction).surface : kNoSurface;
}

Coordinate ExactMap::on_surface(int surface, int x, int y) const {
  const auto direction = view_.direction(x, y);
  if (!direction) return {kBlind, 0};
  return coordinate(*direction, ball_.proxy().closeness(surface, *direction));
}

void ExactMap::on_surfaces(const optics::Vec2Lanes& pixels, MapLanes& lanes) const {
  optics::Vec3Lanes directions;
  view_.directions(pixels, directions);
  optics::Lanes closeness;
  for (std::size_t k = 0; k < kLanes; ++k) {
    const int surface = lanes.surfaces[k];
    closeness[k] = surface < 0 ? 0 : ball_.proxy().closeness(surface, directions.at(k));
  }
  coordinates(directions, closeness, lanes.coordinates);
}

}  // namespace orbwatch::remap
