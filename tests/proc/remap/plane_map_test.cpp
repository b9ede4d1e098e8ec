#include "proc/remap/plane_map.h"

#include <gtest/gtest.h>

#include "tests/proc/remap/random_patch.h"

namespace orbwatch::remap {
namespace {

TEST(PlaneMap, LongStepsReachTheSamePlaces) {
  std::mt19937 random(4);
  for (int round = 0; round < 100; ++round) {
    const Patch patch = tests::RandomPatch(random, {3, 0.1}).patch();
    for (const int bits : {0, 1, 2}) {
      const Patch long_steps = in_steps(patch, bits);
      for (int y = 0; y < kTile >> bits; ++y) {
        for (int x = 0; x < kTile >> bits; ++x) {
          const Coordinate expected = patch.at(x << bits, y << bits), there = long_steps.at(x, y);
          ASSERT_EQ(there.u, expected.u);
          ASSERT_EQ(there.v, expected.v);
        }
      }
    }
  }
}

}  // namespace
}  // namespace orbwatch::remap
