// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include <algorithm>
#include <random>
#include <string>
#include <vector>

#include "proc/remap/kernel/kernel.h"
#include "proc/remap/merge/merge.h"

namespace orbwatch::remap {
namespace {

constexpr int kMargin = 5;

/// Tiles of noise whose shares add up to 255 in each corner.
struct MixScene {
  MixScene(std::size_t count, int samples_per_pixel, std::uint32_t seed)
      : channels(samples_per_pixel), stride(kTile * channels + kMargin), random(seed) {
    std::array<int, 4> rest;
    rest.fill(255);
    for (std::size_t n = 0; n < count; ++n) {
      auto& samples = pictures.emplace_back(kTile * kTile * channels);
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
    out.assign(static_cast<std::size_t>(stride) * kTile, 99);
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
  int expected(int x, int y, int k) const {
    int sum = 0;
    for (std::size_t n = 0; n < tiles.size(); ++n) {
      const int weight = sum_at(n + 1, x, y) - sum_at(n, x, y);
      EXPECT_GE(weight, 0);
      sum += weight * pictures[n][channels * (kTile * y + x) + k];
    }
    return (sum + 127) / 255;
  }

  void check() const {
    for (int y = 0; y < kTile; ++y) {
      const std::uint8_t* const row = &out[static_cast<std::size_t>(y) * stride];
      for (int i = 0; i < kTile * channels; ++i) {
        ASSERT_EQ(row[i], expected(i / channels, y, i % channels)) << i << ", " << y;
      }
      ASSERT_TRUE(std::all_of(row + kTile * channels, row + stride,
                              [](std::uint8_t sample) { return sample == 99; }));
    }
  }

  int channels;
  int stride;
  std::mt19937 random;
  std::vector<std::vector<std::uint8_t>> pictures;
  std::vector<MixedTile> tiles;
  std::vector<std::uint8_t> out;
};

TEST(TileMix, OfEveryKernelIsTheMeanByRoundedSharesAndWritesNothingElse) {
  for (std::size_t count = 1; count <= kMaxSources; ++count) {
    for (const int channels : {1, 3}) {
      for (std::uint32_t seed = 0; seed < 40; ++seed) {
        for (const Kernel* kernel : kernels()) {
          MixScene scene(count, channels, seed);
          kernel->mix(scene.tiles, {scene.out.data(), kTile, kTile, channels, scene.stride});
          SCOPED_TRACE(std::string(kernel->name) + ", " + std::to_string(count) + " sources, " +
                       std::to_string(channels) + " channels, seed " + std::to_string(seed));
          ASSERT_NO_FATAL_FAILURE(scene.check());
        }
      }
    }
  }
}

TEST(TileMix, OfEqualPicturesIsThatPicture) {
  for (std::size_t count = 1; count <= kMaxSources; ++count) {
    MixScene scene(count, 3, static_cast<std::uint32_t>(count));
    for (MixedTile& tile : scene.tiles) tile.samples = scene.pictures[0].data();
    std::vector<std::uint8_t> out(scene.pictures[0].size());
    for (const Kernel* kernel : kernels()) {
      kernel->mix(scene.tiles, {out.data(), kTile, kTile, 3, 3 * kTile});
      EXPECT_EQ(out, scene.pictures[0]) << kernel->name << ", " << count;
    }
  }
}

}  // namespace
}  // namespace orbwatch::remap
