// SPDX-License-Identifier: Apache-2.0
#include "tests/bench/ball_in_picture.h"

#include <cstddef>

#include "proc/optics/rotation.h"

namespace orbwatch::bench {

optics::BallProjection ball_in_picture(int width, int height, double yaw) {
  const double radius = 0.46 * height;
  return optics::BallProjection::make(
             optics::BallModel::make(optics::BallModel::Kind::Exact, 348.5).value(),
             {{(width - 1) / 2.0, (height - 1) / 2.0}, radius, radius, 0},
             optics::rotation({yaw, 0, 0}))
      .value();
}

remap::ColourMap::Table ramp() {
  remap::ColourMap::Table table{};
  for (std::size_t i = 0; i < table.size(); ++i) {
    const auto value = static_cast<std::uint8_t>(i);
    table[i] = {value, static_cast<std::uint8_t>(255 - i), static_cast<std::uint8_t>(value / 2)};
  }
  return table;
}

}  // namespace orbwatch::bench
