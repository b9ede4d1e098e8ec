// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <span>

#include "proc/remap/colour/run_vector.h"
#include "proc/remap/colour/yuv420_tile.h"
#include "proc/remap/kernel/corner_weights.h"
#include "proc/remap/kernel/mixed_tile.h"

#ifdef __aarch64__
#include <arm_neon.h>
#endif

// Mixing of I420 tiles in vectors of a row of a tile, which holds two rows of chroma. Included by
// each kernel and compiled for its instruction set, in an unnamed namespace for the same reason as
// point_walk.h.

namespace orbwatch::remap {
namespace {

/// Sums of the weights of the first 1, 2 .. Count - 1 sources for each sample of a row.
template <std::size_t Count>
using WeightSums = std::array<Bytes, Count - 1>;

/// The means of each two by two of two rows' weights, rounded: once for U, once for V.
[[gnu::always_inline]] inline Bytes weights_of_chroma(const Bytes& upper, const Bytes& lower) {
#ifdef __aarch64__
  // g++ does not generate the instructions that add pairs.
  const uint16x8_t sums = vpadalq_u8(vpaddlq_u8(reinterpret_cast<uint8x16_t>(upper)),
                                     reinterpret_cast<uint8x16_t>(lower));
  const uint8x8_t means = vrshrn_n_u16(sums, 2);
  return reinterpret_cast<Bytes>(vcombine_u8(means, means));
#else
  using Pairs = std::uint16_t __attribute__((vector_size(kRun)));
  using Half = std::uint8_t __attribute__((vector_size(kRun / 2)));
  Pairs a, b;
  std::memcpy(&a, &upper, sizeof a);
  std::memcpy(&b, &lower, sizeof b);
  const Pairs sums = (a & 0xff) + (a >> 8) + (b & 0xff) + (b >> 8);
  const Half means = __builtin_convertvector((sums + 2) >> 2, Half);
  return __builtin_shufflevector(means, means, 0, 1, 2, 3, 4, 5, 6, 7, 0, 1, 2, 3, 4, 5, 6, 7);
#endif
}

/// The mean of a row of each source by their weights, rounded.
template <std::size_t Count>
[[gnu::always_inline]] inline Bytes mean_of(const std::array<const std::uint8_t*, Count>& rows,
                                            const WeightSums<Count>& sums) {
  Words mean{};
  Bytes before{};
  for (std::size_t n = 0; n < Count; ++n) {
    const Bytes until = n + 1 < Count ? sums[n] : Bytes{} + UINT8_MAX;
    mean += widened(until - before) * widened(load<Bytes>(rows[n]));
    before = until;
  }
  return rounded_255th(mean);
}

template <std::size_t Count>
void mix_so_many_yuv420(std::span<const MixedTile> tiles, const Yuv420Planes& out) {
  std::array<CornerWeights, Count - 1> shared;  // sums over the first sources
  const auto corners = shared_corners<Count>(tiles);
  for (std::size_t n = 0; n + 1 < Count; ++n) shared[n] = CornerWeights(corners[n]);
  std::array<const std::uint8_t*, Count> luma, chroma;
  for (std::size_t n = 0; n < Count; ++n) {
    luma[n] = tiles[n].samples;
    chroma[n] = luma[n] + Yuv420Tile::kFirstOfChroma;
  }
  Yuv420Planes to = out;
  const auto write_luma = [&](const WeightSums<Count>& sums) __attribute__((always_inline)) {
    store(mean_of<Count>(luma, sums), to.y.first);
    for (const std::uint8_t*& from : luma) from += kRun;
    to.y.first += to.y.stride;
  };
  for (int row = 0; row < Yuv420Tile::kChromaRows; ++row) {
    WeightSums<Count> upper, lower, both;
    for (std::size_t n = 0; n + 1 < Count; ++n) {
      upper[n] = shared[n].take_row();
      lower[n] = shared[n].take_row();
      both[n] = weights_of_chroma(upper[n], lower[n]);
    }
    write_luma(upper);
    write_luma(lower);
    const Bytes pairs = mean_of<Count>(chroma, both);
    for (const std::uint8_t*& from : chroma) from += kRun;
    std::memcpy(to.u.first, &pairs, kRun / 2);
    std::memcpy(to.v.first, reinterpret_cast<const std::uint8_t*>(&pairs) + kRun / 2, kRun / 2);
    to.u.first += to.u.stride;
    to.v.first += to.v.stride;
  }
}

/// Implements Kernel::mix_yuv420.
inline void mix_yuv420_tiles(std::span<const MixedTile> tiles, const Yuv420Planes& out) {
  with_count(tiles.size(), [&]<std::size_t Count>() { mix_so_many_yuv420<Count>(tiles, out); });
}

}  // namespace
}  // namespace orbwatch::remap
