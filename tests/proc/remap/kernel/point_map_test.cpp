// SPDX-License-Identifier: Apache-2.0
#include "proc/remap/kernel/kernel_map.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <random>

#include "proc/remap/kernel/kernel.h"
#include "tests/proc/remap/kernel/random_patch.h"

namespace orbwatch::remap {
namespace {

struct Rectangle {
  int columns, rows;
};
constexpr std::array kRectangles{Rectangle{16, 16}, Rectangle{16, 8}, Rectangle{8, 16},
                                 Rectangle{8, 8},   Rectangle{4, 8},  Rectangle{4, 4},
                                 Rectangle{2, 4},   Rectangle{2, 2},  Rectangle{1, 1}};

Places located(const Kernel& kernel, const Patch& patch, const Rectangle& r) {
  Places places{};
  kernel.locate(PointMap(patch), r.columns, r.rows, places);
  return places;
}

TEST(PointMap, FollowsThePatch) {
  constexpr double kRounding = (1 << kFractionBits) / 700.0;
  std::mt19937 random(7);
  for (int round = 0; round < 300; ++round) {
    const Patch patch = tests::RandomPatch(random, {round % 2 ? 2.0 : 16.0, 0.3}).patch();
    for (const Rectangle& r : kRectangles) {
      for (const Kernel* kernel : kernels()) {
        const Places places = located(*kernel, patch, r);
        for (int k = 0; k < r.columns * r.rows; ++k) {
          const Coordinate expected = patch.at(k % r.columns, k / r.columns);
          ASSERT_NEAR(places.u[k], expected.u, kRounding + 1) << kernel->name;
          ASSERT_NEAR(places.v[k], expected.v, kRounding + 1) << kernel->name;
        }
      }
    }
  }
}

// The result is also the same where a patch exceeds 32 bits.
TEST(PointMap, IsTheSameForEveryKernel) {
  std::mt19937 random(8);
  for (int round = 0; round < 300; ++round) {
    const Patch patch = tests::RandomPatch(random, {16, 0.5}).patch();
    for (const Rectangle& r : kRectangles) {
      const Places expected = located(*kernels().front(), patch, r);
      for (const Kernel* kernel : kernels()) {
        const Places places = located(*kernel, patch, r);
        ASSERT_TRUE(std::ranges::equal(places.u, expected.u)) << kernel->name;
        ASSERT_TRUE(std::ranges::equal(places.v, expected.v)) << kernel->name;
      }
    }
  }
}

}  // namespace
}  // namespace orbwatch::remap
