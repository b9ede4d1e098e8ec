// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstdint>

#include "proc/remap/colour/run_vector.h"

// The namespace is unnamed for the same reason as in point_walk.h.

namespace orbwatch::remap {
namespace {

/// Weights of a tile's pixels, interpolated linearly between four at its corners (above left, above
/// right, below left, below right; 0 to 255), rounded, row by row. 16 bits hold 256 times them, as
/// unsigned numbers wrap.
struct CornerWeights {
  CornerWeights() = default;
  explicit CornerWeights(const std::array<int, 4>& corners) {
    static_assert(UINT8_MAX * kTile * kTile + kTile * kTile / 2 <= UINT16_MAX);
    const auto [a, b, c, d] = corners;
    constexpr Words kSteps{0, 1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 11, 12, 13, 14, 15};
    const auto first = static_cast<std::uint16_t>(a * kTile * kTile + kTile * kTile / 2);
    row = first + static_cast<std::uint16_t>((b - a) * kTile) * kSteps;
    down = static_cast<std::uint16_t>((c - a) * kTile) +
           static_cast<std::uint16_t>(d - c - b + a) * kSteps;
  }

  [[gnu::always_inline]] Bytes take_row() {
    const Bytes weights = narrowed(row >> 8);
    row += down;
    return weights;
  }

  Words row, down;
};

}  // namespace
}  // namespace orbwatch::remap
