// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>

#include "proc/remap/colour/run.h"
#include "proc/remap/grid/coordinate.h"

namespace orbwatch::remap {

/// A tile of three channels in planes, each of kTile rows of kRun samples: the first is red, or
/// blue where the view's order is B G R.
struct PlanarTile {
  static constexpr std::size_t kPlane = std::size_t{kTile} * kRun;

  std::uint8_t* plane(std::size_t channel) { return samples.data() + channel * kPlane; }
  std::uint8_t* row(std::size_t channel, int y) { return plane(channel) + y * kRun; }

  alignas(64) std::array<std::uint8_t, 3 * kPlane> samples;
};

}  // namespace orbwatch::remap
