#include "proc/remap/exact_map.h"

#include <cmath>

namespace orbwatch::remap {
namespace {

// Half away from zero, as std::lround, which is a call.
std::int32_t fixed(double pixels) {
  const double scaled = pixels * (1 << kFractionBits);
  return static_cast<std::int32_t>(scaled + (scaled < 0 ? -0.5 : 0.5));
}

}  // namespace

Coordinate ExactMap::coordinate(const optics::Vec3& direction, double closeness) const {
  const auto pixel = ball_.pixel(direction, closeness);
  if (!pixel) return {kBlind, 0};
  // A ball far larger than the picture could exceed the fixed point's range.
  constexpr double kRange = 1 << (30 - kFractionBits);
  const bool fits = std::abs(pixel->u) <= kRange && std::abs(pixel->v) <= kRange;
  return fits ? Coordinate{fixed(pixel->u), fixed(pixel->v)} : Coordinate{kOutside, 0};
}

ExactMap::Sight ExactMap::see(int x, int y) const {
  const auto direction = view_.direction(x, y);
  if (!direction) return {};
  const auto hit = ball_.proxy().hit(*direction);
  return {hit.surface, coordinate(*direction, hit.closeness)};
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

}  // namespace orbwatch::remap
