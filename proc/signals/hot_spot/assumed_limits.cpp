// SPDX-License-Identifier: Apache-2.0
#include "proc/signals/hot_spot/assumed_limits.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace orbwatch::signals {
namespace {

/// Area of a pixel on the surface, assuming that it faces the ball, mm2; infinite if far.
double footprint(const optics::ViewProjection& view, const RegionScene& scene, int x, int y) {
  const auto direction = view.direction(x, y);
  const double closeness = direction ? scene.proxy.hit(*direction).closeness : 0;
  if (!(closeness > 0)) return std::numeric_limits<double>::infinity();
  const double distance = scene.ball.radius / closeness;
  return view.solid_angle(x, y) * distance * distance;
}

}  // namespace

HotSpotLimits assumed_limits(const optics::ViewProjection& view, const RegionScene& scene,
                             std::span<const optics::Vec3> outline, double frame_rate) {
  const auto mask = RegionMask::make(view, outline);
  if (!mask || scene.proxy.is_far()) return {};
  double finest = std::numeric_limits<double>::infinity();
  for (const Span& span : mask->spans()) {
    for (const int x : {span.begin, (span.begin + span.end) / 2, span.end - 1}) {
      finest = std::min(finest, footprint(view, scene, x, span.y));
    }
  }
  if (!std::isfinite(finest)) return {};
  return {finest, std::max(kAssumedSpeed, std::sqrt(finest) * frame_rate)};
}

}  // namespace orbwatch::signals
