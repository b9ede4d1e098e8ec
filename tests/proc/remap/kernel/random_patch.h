// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <cstdint>
#include <cstdlib>
#include <random>

#include "proc/remap/kernel/kernel_map.h"

/// Patches of any rotation, shear and curvature.
namespace orbwatch::tests {

/// Slope and curvature of a map, source pixels per pixel and per square pixel.
struct Steepness {
  double slope, curvature;
};

class RandomPatch {
 public:
  RandomPatch(std::mt19937& random, const Steepness& most)
      : u_(random_axis(random, most)), v_(random_axis(random, most)) {}

  /// The same patch with `factor` 2^20ths of the slope and curvature.
  remap::Patch scaled(std::int64_t factor) const {
    return {scaled(u_, factor), scaled(v_, factor)};
  }
  remap::Patch patch() const { return {u_, v_}; }

  /// The steepest patch of this shape that still fits, to the last bit, into these columns and rows
  /// of its windows.
  remap::Patch steepest(int blocks_x, int blocks_y, int columns = remap::kWindow,
                        int rows = remap::kWindow) const {
    std::int64_t fits = 0, too_steep = largest_factor();
    while (too_steep - fits > 1) {
      const std::int64_t middle = (fits + too_steep) / 2;
      remap::BlockMap map;
      const bool fit = map.fit(scaled(middle), remap::kBlock * blocks_x, remap::kBlock * blocks_y,
                               remap::BlockMap::rounding(0, 0)) &&
                       map.is_within(columns, rows);
      (fit ? fits : too_steep) = middle;
    }
    return scaled(fits);
  }

 private:
  /// Largest factor at which its numbers stay those of a patch on nodes, which are not
  /// is_too_steep().
  std::int64_t largest_factor() const {
    constexpr std::int64_t kMostSlope = std::int64_t{remap::kSteepest} << 24;
    constexpr std::int64_t kMostCurvature = 4 * kMostSlope >> 7;  // for twelve nodes
    std::int64_t factor = std::int64_t{1} << 26;
    const auto keep = [&factor](std::int64_t value, std::int64_t most) {
      if (value != 0) factor = std::min(factor, (most << 20) / std::abs(value));
    };
    for (const remap::Quadratic& axis : {u_, v_}) {
      for (const std::int64_t slope : {axis.x, axis.y}) keep(slope, kMostSlope);
      for (const std::int64_t bend : {axis.xx, axis.yy, axis.xy}) keep(bend, kMostCurvature);
    }
    return factor;
  }
  static remap::Quadratic random_axis(std::mt19937& random, const Steepness& most) {
    const auto q24 = [&random](double range) {
      return static_cast<std::int64_t>(std::uniform_real_distribution(-range, range)(random) *
                                       (1 << 24));
    };
    return {q24(4000),           q24(most.slope),     q24(most.slope),
            q24(most.curvature), q24(most.curvature), q24(most.curvature)};
  }
  static remap::Quadratic scaled(const remap::Quadratic& q, std::int64_t factor) {
    const auto times = [factor](std::int64_t value) { return value * factor >> 20; };
    return {q.value, times(q.x), times(q.y), times(q.xy), times(q.xx), times(q.yy)};
  }

  remap::Quadratic u_, v_;
};

}  // namespace orbwatch::tests
