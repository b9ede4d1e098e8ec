// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <numeric>

#include "proc/remap/compiler/tolerance.h"
#include "proc/remap/grid/tile.h"
#include "proc/remap/grid/tile_stores.h"

/// The mip level of the source for a tile, from its step from pixel to pixel.
namespace orbwatch::remap {

/// The square of the largest step between neighbouring pixels, in source pixels, for one bilinear
/// sample per pixel: a larger step loses more than averaging would.
inline constexpr float kLargestStep2 = 1.4F * 1.4F;

/// The lowest level at which steps whose larger square is `step2` are allowed. Branch-free, for
/// loops over many.
constexpr std::int32_t level_of_step2(float step2) {
  static_assert(kMaxLevel == 3);
  return std::int32_t{step2 > kLargestStep2} + std::int32_t{step2 > 4 * kLargestStep2} +
         std::int32_t{step2 > 16 * kLargestStep2};
}
/// The factor 2^level.
constexpr float scale_of_step2(float step2) {
  return (step2 > kLargestStep2 ? 2.0F : 1.0F) * (step2 > 4 * kLargestStep2 ? 2.0F : 1.0F) *
         (step2 > 16 * kLargestStep2 ? 2.0F : 1.0F);
}

/// The square of a step to the next pixel, from the coordinates at both ends of `pixels` steps.
inline float step2(const Coordinate& from, const Coordinate& to, int pixels) {
  const auto scale = static_cast<float>(1 / (kOnePixel * pixels));
  const float u = static_cast<float>(std::int64_t{to.u} - from.u) * scale;
  const float v = static_cast<float>(std::int64_t{to.v} - from.v) * scale;
  return u * u + v * v;
}

/// `along_x`, `along_y`: squares of the steps to the next pixels.
inline std::uint8_t level_of_steps2(float along_x, float along_y) {
  return static_cast<std::uint8_t>(level_of_step2(std::max(along_x, along_y)));
}

/// The level in the middle of a patch.
inline std::uint8_t level_of(const Stencil& nodes) {
  const auto middle = [&](int i0, int j0, int i1, int j1) {
    return Coordinate{std::midpoint(nodes.at(i0, j0).u, nodes.at(i1, j1).u),
                      std::midpoint(nodes.at(i0, j0).v, nodes.at(i1, j1).v)};
  };
  return level_of_steps2(step2(middle(0, 0, 0, 1), middle(1, 0, 1, 1), kTile),
                         step2(middle(0, 0, 1, 0), middle(0, 1, 1, 1), kTile));
}

template <int Cell>
std::uint8_t level_of(const FineTile<Cell>& fine) {
  constexpr int kMiddle = 1 + FineTile<Cell>::kCells / 2;
  const auto at = [&](int i, int j) { return fine.nodes[kMiddle + j][kMiddle + i]; };
  return level_of_steps2(step2(at(-1, 0), at(1, 0), 2 * Cell),
                         step2(at(0, -1), at(0, 1), 2 * Cell));
}

/// The level of a tile without a smooth map: from the median of its pixels' steps, which a jump or
/// the limb's bend does not affect.
inline std::uint8_t level_of(const CoordinateTile& pixels) {
  std::array<float, kTile * kTile> steps2;
  std::size_t count = 0;
  for (int y = 0; y + 1 < kTile; ++y) {
    for (int x = 0; x + 1 < kTile; ++x) {
      const Coordinate &here = pixels[y][x], &right = pixels[y][x + 1], &below = pixels[y + 1][x];
      if (!is_defined(here) || !is_defined(right) || !is_defined(below)) continue;
      steps2[count++] = std::max(step2(here, right, 1), step2(here, below, 1));
    }
  }
  if (count == 0) return 0;
  const auto median = steps2.begin() + static_cast<std::ptrdiff_t>(count / 2);
  std::nth_element(steps2.begin(), median, steps2.begin() + static_cast<std::ptrdiff_t>(count));
  return static_cast<std::uint8_t>(level_of_step2(*median));
}

}  // namespace orbwatch::remap
