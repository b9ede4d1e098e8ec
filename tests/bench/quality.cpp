// SPDX-License-Identifier: Apache-2.0
#include "tests/bench/quality.h"

#include <algorithm>
#include <cmath>

namespace orbwatch::bench {
namespace {

double bilinear(const Plane& plane, const optics::Vec2& place, int k) {
  const int x = std::clamp(static_cast<int>(std::floor(place.u)), 0, plane.width - 2);
  const int y = std::clamp(static_cast<int>(std::floor(place.v)), 0, plane.height - 2);
  const double wx = std::clamp(place.u - x, 0.0, 1.0), wy = std::clamp(place.v - y, 0.0, 1.0);
  const auto row = [&](int v) {
    return (1 - wx) * plane.sample(x, v, k) + wx * plane.sample(x + 1, v, k);
  };
  return (1 - wy) * row(y) + wy * row(y + 1);
}

}  // namespace

Quality quality_of(const Rig& rig, const Frame& source, const Frame& view) {
  const Plane& from = source.planes.front();
  const Plane& to = view.planes.front();
  const double unit = from.sample_bytes == 1 ? 1 : 257;
  Quality quality;
  double squares = 0, count = 0;
  const auto map = rig.exact_map();
  const auto* place = map.data();
  for (int y = 0; y < to.height; ++y) {
    for (int x = 0; x < to.width; ++x, ++place) {
      if (!*place) continue;
      for (int k = 0; k < to.samples; ++k) {
        const double error = (to.sample(x, y, k) - bilinear(from, **place, k)) / unit;
        quality.max = std::max(quality.max, std::abs(error));
        squares += error * error;
        ++count;
      }
    }
  }
  quality.rms = std::sqrt(squares / count);
  return quality;
}

}  // namespace orbwatch::bench
