// SPDX-License-Identifier: Apache-2.0
#include "tests/bench/rig.h"

#include <algorithm>
#include <cstddef>

namespace orbwatch::bench {
namespace {

optics::ViewProjection projection_of(const NamedView& named) {
  optics::ViewSpec spec{named.kind, named.orientation, {}, {}, named.width, named.height};
  if (named.kind == optics::ViewKind::Perspective) spec.h_fov = 90;
  return optics::ViewProjection::make(spec).value();
}

/// Radius of 1490 px in a picture of 3000, and in proportion for other sizes.
optics::BallProjection ball_in(int source) {
  const double middle = (source - 1) / 2.0, radius = source * (1490.0 / 3000);
  return optics::BallProjection::make(
             optics::BallModel::make(optics::BallModel::Kind::Exact, 348.5).value(),
             {{middle, middle}, radius, radius, 0}, {})
      .value();
}

}  // namespace

std::optional<NamedView> find_view(std::string_view name) {
  const auto* found = std::find_if(kViews.begin(), kViews.end(),
                                   [&](const NamedView& view) { return view.name == name; });
  return found == kViews.end() ? std::nullopt : std::optional(*found);
}

Rig::Rig(const NamedView& chosen, int source_side)
    : named(chosen), source(source_side), view(projection_of(chosen)), ball(ball_in(source_side)) {}

std::vector<std::optional<optics::Vec2>> Rig::exact_map(int divisor) const {
  // Pixel k of the smaller picture covers the larger one's k * divisor .. (k + 1) * divisor - 1.
  const double shift = (divisor - 1) / 2.0;
  const int width = named.width / divisor, height = named.height / divisor;
  std::vector<std::optional<optics::Vec2>> map(static_cast<std::size_t>(width) * height);
  auto* next = map.data();
  for (int y = 0; y < height; ++y) {
    for (int x = 0; x < width; ++x, ++next) {
      const auto direction = view.direction(x * divisor + shift, y * divisor + shift);
      const auto place = direction ? ball.pixel(*direction) : std::nullopt;
      if (place) *next = optics::Vec2{(place->u - shift) / divisor, (place->v - shift) / divisor};
    }
  }
  return map;
}

}  // namespace orbwatch::bench
