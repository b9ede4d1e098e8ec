// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include <algorithm>
#include <string>
#include <vector>

#include "proc/remap/kernel/kernel.h"
#include "tests/proc/remap/kernel/mix_scene.h"

namespace orbwatch::remap {
namespace {

constexpr int kMargin = 5;

/// Tiles of pixels, and their mixture.
struct PixelMix : MixScene {
  PixelMix(std::size_t count, int samples_per_pixel, std::uint32_t seed)
      : MixScene(count, static_cast<std::size_t>(kTile) * kTile * samples_per_pixel, seed),
        channels(samples_per_pixel),
        stride(kTile * channels + kMargin),
        out(static_cast<std::size_t>(stride) * kTile, 99) {}

  int expected(int x, int y, int k) const {
    return mean(static_cast<std::size_t>(channels) * (kTile * y + x) + k,
                [&](std::size_t n) { return sum_at(n, x, y); });
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
  std::vector<std::uint8_t> out;
};

TEST(TileMix, OfEveryKernelIsTheMeanByRoundedSharesAndWritesNothingElse) {
  for (std::size_t count = 1; count <= kMaxSources; ++count) {
    for (const int channels : {1, 3}) {
      for (std::uint32_t seed = 0; seed < 40; ++seed) {
        for (const Kernel* kernel : kernels()) {
          PixelMix scene(count, channels, seed);
          kernel->mix(scene.tiles, {scene.out.data(), kTile, kTile, channels, scene.stride});
          SCOPED_TRACE(std::string(kernel->name) + ", " + std::to_string(count) + " sources, " +
                       std::to_string(channels) + " channels, seed " + std::to_string(seed));
          ASSERT_NO_FATAL_FAILURE(scene.check());
        }
      }
    }
  }
}

// The channels of the same samples, one after the other.
TEST(TileMix, OfPlanesIsThatOfPixels) {
  for (const Kernel* kernel : kernels()) {
    if (kernel->mix_planes == nullptr) continue;
    for (std::size_t count = 1; count <= kMaxSources; ++count) {
      for (std::uint32_t seed = 0; seed < 40; ++seed) {
        PixelMix scene(count, 3, seed);
        std::vector<PlanarTile> planes(count);
        for (std::size_t n = 0; n < count; ++n) {
          for (std::size_t i = 0; i < planes[n].samples.size(); ++i) {
            planes[n].plane(i % 3)[i / 3] = scene.pictures[n][i];
          }
          scene.tiles[n].samples = planes[n].samples.data();
        }
        kernel->mix_planes(scene.tiles, {scene.out.data(), kTile, kTile, 3, scene.stride});
        SCOPED_TRACE(std::string(kernel->name) + ", " + std::to_string(count) + " sources, seed " +
                     std::to_string(seed));
        ASSERT_NO_FATAL_FAILURE(scene.check());
      }
    }
  }
}

TEST(TileMix, OfEqualPicturesIsThatPicture) {
  for (std::size_t count = 1; count <= kMaxSources; ++count) {
    PixelMix scene(count, 3, static_cast<std::uint32_t>(count));
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
