// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

#include "proc/remap/colour/yuv420_tile.h"
#include "proc/remap/kernel/kernel.h"
#include "tests/proc/remap/kernel/mix_scene.h"
#include "tests/proc/remap/untouched.h"

namespace orbwatch::remap {
namespace {

using tests::kUntouched;

/// Tiles of I420, and their mixture in planes with some bytes between their rows.
struct Yuv420Mix : MixScene {
  static constexpr int kGap = 5, kHalf = kTile / 2;

  Yuv420Mix(std::size_t count, std::uint32_t seed)
      : MixScene(count, Yuv420Tile().samples.size(), seed) {}

  Yuv420Planes planes() {
    return {{y.data(), kTile + kGap}, {u.data(), kHalf + kGap}, {v.data(), kHalf + kGap + 1}};
  }
  int luma(int column, int row) const {
    return mean(static_cast<std::size_t>(kTile) * row + column,
                [&](std::size_t n) { return sum_at(n, column, row); });
  }
  /// `plane`: 0 for U, 1 for V.
  int chroma(int plane, int column, int row) const {
    const std::ptrdiff_t at = Yuv420Tile::kFirstOfChroma + kTile * row + kHalf * plane + column;
    return mean(static_cast<std::size_t>(at), [&](std::size_t n) {
      int sum = 2;
      for (const int i : {0, 1}) {
        for (const int j : {0, 1}) sum += sum_at(n, 2 * column + i, 2 * row + j);
      }
      return sum / 4;
    });
  }

  /// `of(column, row)`: the samples that are expected in a plane.
  template <class Of>
  static void check(const std::vector<std::uint8_t>& plane, std::ptrdiff_t stride, int side,
                    const Of& of) {
    for (int k = 0; k < std::ssize(plane); ++k) {
      const int column = static_cast<int>(k % stride), row = static_cast<int>(k / stride);
      const bool is_gap = column >= side || row >= side;
      ASSERT_EQ(plane[k], is_gap ? kUntouched : of(column, row)) << column << ", " << row;
    }
  }
  void check() {
    check(y, kTile + kGap, kTile, [&](int column, int row) { return luma(column, row); });
    check(u, kHalf + kGap, kHalf, [&](int column, int row) { return chroma(0, column, row); });
    check(v, kHalf + kGap + 1, kHalf, [&](int column, int row) { return chroma(1, column, row); });
  }

  std::vector<std::uint8_t> y = std::vector<std::uint8_t>((kTile + kGap) * kTile, kUntouched),
                            u = std::vector<std::uint8_t>((kHalf + kGap) * kHalf, kUntouched),
                            v = std::vector<std::uint8_t>((kHalf + kGap + 1) * kHalf, kUntouched);
};

TEST(Yuv420Mix, OfEveryKernelIsTheMeanByRoundedSharesAndWritesNothingElse) {
  for (std::size_t count = 1; count <= kMaxSources; ++count) {
    for (std::uint32_t seed = 0; seed < 40; ++seed) {
      for (const Kernel* kernel : kernels()) {
        SCOPED_TRACE(std::string(kernel->name) + ", " + std::to_string(count) + " sources, seed " +
                     std::to_string(seed));
        Yuv420Mix mix(count, seed);
        kernel->mix_yuv420(mix.tiles, mix.planes());
        ASSERT_NO_FATAL_FAILURE(mix.check());
      }
    }
  }
}

TEST(Yuv420Mix, OfEqualPicturesIsThatPicture) {
  for (std::size_t count = 1; count <= kMaxSources; ++count) {
    Yuv420Mix mix(count, static_cast<std::uint32_t>(count));
    for (MixedTile& tile : mix.tiles) tile.samples = mix.pictures[0].data();
    for (const Kernel* kernel : kernels()) {
      Yuv420Tile out;
      kernel->mix_yuv420(mix.tiles, out.planes());
      EXPECT_TRUE(std::ranges::equal(out.samples, mix.pictures[0]))
          << kernel->name << ", " << count;
    }
  }
}

}  // namespace
}  // namespace orbwatch::remap
