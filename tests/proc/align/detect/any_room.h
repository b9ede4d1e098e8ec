// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cmath>
#include <cstdint>
#include <numbers>
#include <random>

#include "tests/support/mirror_room.h"

namespace orbwatch::tests {

/// Settings of a random room with the contents of real machines, and more.
inline MirrorRoomSettings any_room(std::uint64_t seed) {
  std::mt19937_64 random(seed);
  const auto in = [&](double low, double high) {
    return std::uniform_real_distribution<double>(low, high)(random);
  };
  MirrorRoomSettings s;
  s.seed = seed;
  s.thermal = in(0, 1) < 0.2;
  s.width = s.thermal ? 320 : in(0, 1) < 0.5 ? 800 : 1280;
  s.height = s.thermal ? 256 : s.width * 3 / 4;
  s.distance = std::exp(in(std::log(4), std::log(40)));
  s.radius = s.thermal ? in(50, 115) : in(60, 0.48 * s.height);
  const double off = in(0, 0.6), way = in(0, 2 * std::numbers::pi);
  s.off_axis = {off * std::cos(way), off * std::sin(way)};
  while (share_outside(s) > 0.2) s.off_axis = {0.9 * s.off_axis.u, 0.9 * s.off_axis.v};
  s.limb_hidden = in(0, 1) < 0.7 ? in(0, 0.3) : 0;
  s.exposure = in(-2, 2);
  s.noise = s.thermal ? in(1, 4) : in(0.5, 5);
  s.blur = in(0.3, 2);
  return s;
}

}  // namespace orbwatch::tests
