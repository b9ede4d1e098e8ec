// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>

namespace orbwatch::remap {

/// Most sources that one view can merge.
inline constexpr std::size_t kMaxSources = 4;

/// Shares of 255 in a tile's corners: above left, above right, below left, below right.
using CornerShares = std::array<std::uint8_t, 4>;

/// One source of a mixed tile.
struct MixedTile {
  const std::uint8_t* samples = nullptr;  ///< rows of kTile pixels, or those of a Yuv420Tile
  CornerShares shares{};
};

/// Sums of the shares of the first 1, 2 .. Count - 1 sources.
template <std::size_t Count>
[[gnu::always_inline]] inline std::array<std::array<int, 4>, Count - 1> shared_corners(
    std::span<const MixedTile> tiles) {
  std::array<std::array<int, 4>, Count - 1> shared;
  std::array<int, 4> sums{};
  for (std::size_t n = 0; n + 1 < Count; ++n) {
    for (std::size_t corner = 0; corner < 4; ++corner) sums[corner] += tiles[n].shares[corner];
    shared[n] = sums;
  }
  return shared;
}

/// Calls `mix<Count>()` for 1 to kMaxSources sources.
template <class Mix>
[[gnu::always_inline]] inline void with_count(std::size_t count, const Mix& mix) {
  static_assert(kMaxSources == 4);
  switch (count) {
    case 1:
      return mix.template operator()<1>();
    case 2:
      return mix.template operator()<2>();
    case 3:
      return mix.template operator()<3>();
    default:
      return mix.template operator()<4>();
  }
}

/// Calls `mix<Channels, Count>()` for pictures of 1 or 3 channels and 1 to kMaxSources sources.
template <class Mix>
[[gnu::always_inline]] inline void with_constants(int channels, std::size_t count, const Mix& mix) {
  with_count(
      count, [&]<std::size_t Count>() __attribute__((always_inline)) {
        channels == 1 ? mix.template operator()<1, Count>() : mix.template operator()<3, Count>();
      });
}

}  // namespace orbwatch::remap
