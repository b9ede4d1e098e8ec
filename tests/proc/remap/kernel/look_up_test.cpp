// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include <algorithm>
#include <random>
#include <span>
#include <string>
#include <vector>

#include "proc/remap/colour/run.h"
#include "proc/remap/kernel/kernel.h"
#include "tests/proc/remap/untouched.h"
#include "tests/support/guarded_memory.h"

namespace orbwatch::remap {
namespace {

using tests::kUntouched;

class LookUp : public testing::TestWithParam<const Kernel*> {};

ColourTable noise(std::mt19937& random, int channels) {
  ColourTable table{channels};
  for (std::size_t i = 0; i < 256; ++i) {
    const auto byte = [&] { return static_cast<std::uint8_t>(random()); };
    table.set(i, {byte(), byte(), byte()});
  }
  return table;
}

// Indices end where memory does, and so do the pixels: nothing beyond either is touched.
TEST_P(LookUp, WritesTheColoursOfEveryRunAndNothingElse) {
  std::mt19937 random(11);
  tests::GuardedMemory index_memory(kTile * 40), out_memory(kTile * 3 * 60);
  for (const int channels : {1, 3}) {
    const ColourTable table = noise(random, channels);
    for (int rows = 1; rows <= kTile; ++rows) {
      for (const std::ptrdiff_t apart : {0, 24}) {
        for (const std::ptrdiff_t gap : {0, 7}) {
          SCOPED_TRACE(testing::Message() << channels << " channels, " << rows << " rows, " << apart
                                          << " and " << gap << " bytes between them");
          const std::ptrdiff_t stride = kRun + apart, out_stride = kRun * channels + gap;
          const std::span indices = index_memory.last((rows - 1) * stride + kRun);
          const std::span out = out_memory.last((rows - 1) * out_stride + kRun * channels);
          std::ranges::generate(indices, [&] { return static_cast<std::uint8_t>(random()); });
          std::ranges::fill(out, kUntouched);
          GetParam()->look_up(table, {indices.data(), stride, rows},
                              {out.data(), kRun, rows, channels, out_stride});
          for (std::ptrdiff_t k = 0; k < std::ssize(out); ++k) {
            const std::ptrdiff_t row = k / out_stride, sample = k % out_stride;
            const bool is_gap = sample >= kRun * channels;
            const std::size_t index = is_gap ? 0 : indices[row * stride + sample / channels];
            ASSERT_EQ(out[k], is_gap ? kUntouched : table.planes[sample % channels][index]) << k;
          }
        }
      }
    }
  }
}

TEST(LookUpPlanes, WriteTheChannelsOfATile) {
  std::mt19937 random(13);
  const ColourTable table = noise(random, 3);
  tests::GuardedMemory index_memory(kTile * kRun);
  const std::span indices = index_memory.last(kTile * kRun);
  std::ranges::generate(indices, [&] { return static_cast<std::uint8_t>(random()); });
  for (const Kernel* kernel : kernels()) {
    if (kernel->look_up_planes == nullptr) continue;
    PlanarTile out;
    kernel->look_up_planes(table, indices.data(), out);
    for (std::size_t channel = 0; channel < 3; ++channel) {
      for (std::size_t k = 0; k < indices.size(); ++k) {
        ASSERT_EQ(out.plane(channel)[k], table.planes[channel][indices[k]]) << channel << ", " << k;
      }
    }
  }
}

TEST_P(LookUp, MeansTheChromaOfEachFourPixels) {
  std::mt19937 random(12);
  constexpr int kHalf = kTile / 2;
  for (const std::ptrdiff_t apart : {0, 24}) {
    const ColourTable table = noise(random, 1);
    const std::ptrdiff_t stride = kRun + apart;
    tests::GuardedMemory index_memory(kTile * 40), luma_memory(kTile * 20), u_memory(kTile * 20),
        v_memory(kTile * 20);
    const std::span indices = index_memory.last((kTile - 1) * stride + kRun);
    std::ranges::generate(indices, [&] { return static_cast<std::uint8_t>(random()); });
    const std::span y = luma_memory.last(kTile * kTile), u = u_memory.last(kHalf * kHalf),
                    v = v_memory.last(kHalf * kHalf);
    GetParam()->look_up_yuv420(table, {indices.data(), stride, kTile},
                               {{y.data(), kTile}, {u.data(), kHalf}, {v.data(), kHalf}});
    const auto entry = [&](std::size_t plane, int column, int row) -> int {
      return table.planes[plane][indices[row * stride + column]];
    };
    for (int k = 0; k < kTile * kTile; ++k) ASSERT_EQ(y[k], entry(0, k % kTile, k / kTile)) << k;
    for (int k = 0; k < kHalf * kHalf; ++k) {
      const int column = 2 * (k % kHalf), row = 2 * (k / kHalf);
      const auto mean = [&](std::size_t plane) {
        return (entry(plane, column, row) + entry(plane, column + 1, row) +
                entry(plane, column, row + 1) + entry(plane, column + 1, row + 1) + 2) /
               4;
      };
      ASSERT_EQ(u[k], mean(1)) << k;
      ASSERT_EQ(v[k], mean(2)) << k;
    }
  }
}

INSTANTIATE_TEST_SUITE_P(Kernels, LookUp, testing::ValuesIn(kernels().begin(), kernels().end()),
                         [](const auto& kernel) { return std::string(kernel.param->name); });

}  // namespace
}  // namespace orbwatch::remap
