// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <random>
#include <vector>

#include "proc/remap/grid/coordinate.h"
#include "proc/remap/kernel/mixed_tile.h"

namespace orbwatch::remap {

/// Tiles of noise whose shares add up to 255 in each corner.
struct MixScene {
  MixScene(std::size_t count, std::size_t samples_per_tile, std::uint32_t seed) : random(seed) {
    std::array<int, 4> rest;
    rest.fill(255);
    for (std::size_t n = 0; n < count; ++n) {
      auto& samples = pictures.emplace_back(samples_per_tile);
      for (auto& sample : samples) sample = static_cast<std::uint8_t>(extreme_or(random() % 256));
      MixedTile& tile = tiles.emplace_back();
      for (std::size_t corner = 0; corner < 4; ++corner) {
        const int share =
            n + 1 == count ? rest[corner] : extreme_or(random() % 256) % (rest[corner] + 1);
        tile.shares[corner] = static_cast<std::uint8_t>(share);
        rest[corner] -= share;
      }
    }
    for (std::size_t n = 0; n < count; ++n) tiles[n].samples = pictures[n].data();
  }

  int extreme_or(std::uint32_t value) {
    const auto kind = random() % 8;
    return kind == 0 ? 0 : kind == 1 ? 255 : static_cast<int>(value);
  }

  /// The weights of the first `count` sources together, exactly rounded.
  int sum_at(std::size_t count, int x, int y) const {
    if (count == tiles.size()) return 255;
    int sum = 0;
    for (std::size_t n = 0; n < count; ++n) {
      const auto [a, b, c, d] = tiles[n].shares;
      sum += (a * (kTile - x) + b * x) * (kTile - y) + (c * (kTile - x) + d * x) * y;
    }
    return (sum + kTile * kTile / 2) / (kTile * kTile);
  }

  /// The mean of the sources' samples `at` bytes from their first; `sum_of(n)` is the weight of the
  /// first n sources together.
  template <class SumOf>
  int mean(std::size_t at, const SumOf& sum_of) const {
    int sum = 0;
    for (std::size_t n = 0; n < tiles.size(); ++n) {
      sum += (sum_of(n + 1) - sum_of(n)) * pictures[n][at];
    }
    return (sum + 127) / 255;
  }

  std::mt19937 random;
  std::vector<std::vector<std::uint8_t>> pictures;
  std::vector<MixedTile> tiles;
};

}  // namespace orbwatch::remap
