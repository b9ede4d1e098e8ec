// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>

#include "proc/image/image_view.h"
#include "proc/remap/colour/run_vector.h"
#include "proc/remap/kernel/corner_weights.h"
#include "proc/remap/kernel/mixed_tile.h"

// Tile mixing of kernels in vectors of a row of a tile, which compilers spread over the available
// registers.
//
// Included by each kernel and compiled for its instruction set, in an unnamed namespace for the
// same reason as point_walk.h.

namespace orbwatch::remap {
namespace {

template <int Channels, std::size_t Count>
void mix_so_many(std::span<const MixedTile> tiles, const ImageView<std::uint8_t>& out) {
  std::array<CornerWeights, Count - 1> shared;  // sums over the first sources
  const auto corners = shared_corners<Count>(tiles);
  for (std::size_t n = 0; n + 1 < Count; ++n) shared[n] = CornerWeights(corners[n]);
  std::array<const std::uint8_t*, Count> from;
  for (std::size_t n = 0; n < Count; ++n) from[n] = tiles[n].samples;
  std::uint8_t* to = out.data;
  for (int y = 0; y < kTile; ++y, to += out.stride) {
    std::array<Words, Channels> means{};
    Bytes before{};
    for (std::size_t n = 0; n < Count; ++n) {
      const Bytes until = n + 1 < Count ? shared[n].take_row() : Bytes{} + UINT8_MAX;
      const Bytes weights = until - before;
      before = until;
      for (int part = 0; part < Channels; ++part) {
        means[part] +=
            widened(spread<Channels>(weights, part)) * widened(load<Bytes>(from[n] + kRun * part));
      }
      from[n] += kRun * Channels;
    }
    for (int part = 0; part < Channels; ++part) {
      store(rounded_255th(means[part]), to + kRun * part);
    }
  }
}

/// Implements Kernel::mix.
inline void mix_tiles(std::span<const MixedTile> tiles, const ImageView<std::uint8_t>& out) {
  with_constants(out.channels, tiles.size(), [&]<int Channels, std::size_t Count>() {
    mix_so_many<Channels, Count>(tiles, out);
  });
}

}  // namespace
}  // namespace orbwatch::remap
