// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <arm_neon.h>

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>

#include "proc/image/image_view.h"
#include "proc/remap/colour/planar_tile.h"
#include "proc/remap/kernel/corner_weights.h"
#include "proc/remap/kernel/mixed_tile.h"
#include "proc/remap/kernel/narrow_neon.h"

// Mixing of tiles in planes by the kernel for NEON: a weight for each sample as they lie, and the
// store interleaves the channels.

namespace orbwatch::remap::neon {
namespace {

/// The mean of a run of each source, rounded; the weights add up to 255.
template <std::size_t Count>
[[gnu::always_inline]] inline uint8x16_t mean_of_runs(const std::array<uint8x16_t, Count>& weights,
                                                      const std::array<uint8x16_t, Count>& runs) {
  uint16x8_t low = vmull_u8(vget_low_u8(runs[0]), vget_low_u8(weights[0]));
  uint16x8_t high = vmull_high_u8(runs[0], weights[0]);
  for (std::size_t n = 1; n < Count; ++n) {
    low = vmlal_u8(low, vget_low_u8(runs[n]), vget_low_u8(weights[n]));
    high = vmlal_high_u8(high, runs[n], weights[n]);
  }
  // The same as rounded_255th(): a sum m is (m + ((m + 128) >> 8) + 128) >> 8.
  return rounded_shift<8>(vrsraq_n_u16(low, low, 8), vrsraq_n_u16(high, high, 8));
}

template <std::size_t Count>
void mix_so_many_planes(std::span<const MixedTile> tiles, const ImageView<std::uint8_t>& out) {
  std::array<CornerWeights, Count - 1> shared;  // sums over the first sources
  const auto corners = shared_corners<Count>(tiles);
  for (std::size_t n = 0; n + 1 < Count; ++n) shared[n] = CornerWeights(corners[n]);
  std::array<const std::uint8_t*, Count> from;
  for (std::size_t n = 0; n < Count; ++n) from[n] = tiles[n].samples;
  std::uint8_t* to = out.data;
  const std::ptrdiff_t stride = out.stride;
  constexpr int kUnrolled = 4;
  for (int y = 0; y < kTile; y += kUnrolled) {
#pragma GCC unroll 4
    for (int row = 0; row < kUnrolled; ++row, to += stride) {
      std::array<uint8x16_t, Count> weights;
      uint8x16_t before = vdupq_n_u8(0);
      for (std::size_t n = 0; n + 1 < Count; ++n) {
        const auto until = reinterpret_cast<uint8x16_t>(shared[n].take_row());
        weights[n] = n == 0 ? until : vsubq_u8(until, before);
        before = until;
      }
      weights[Count - 1] = vmvnq_u8(before);
      const auto mean = [&](std::size_t channel) __attribute__((always_inline)) {
        std::array<uint8x16_t, Count> runs;
        for (std::size_t n = 0; n < Count; ++n) {
          runs[n] = vld1q_u8(from[n] + channel * PlanarTile::kPlane + row * kRun);
        }
        return mean_of_runs<Count>(weights, runs);
      };
      const uint8x16x3_t pixels{{mean(0), mean(1), mean(2)}};
      vst3q_u8(to, pixels);
    }
    for (const std::uint8_t*& rows : from) rows += kUnrolled * kRun;
  }
}

/// Implements Kernel::mix_planes.
inline void mix_planes(std::span<const MixedTile> tiles, const ImageView<std::uint8_t>& out) {
  with_count(tiles.size(), [&]<std::size_t Count>() { mix_so_many_planes<Count>(tiles, out); });
}

}  // namespace
}  // namespace orbwatch::remap::neon
