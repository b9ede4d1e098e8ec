#pragma once

#include <array>
#include <cstddef>
#include <cstdint>

namespace orbwatch::remap {

/// Sources that one view can merge.
inline constexpr std::size_t kMaxSources = 4;

/// Shares of 255 in a tile's corners: above left, above right, below left, below right.
using CornerShares = std::array<std::uint8_t, 4>;

/// One source of a mixed tile.
struct MixedTile {
  const std::uint8_t* samples = nullptr;  ///< rows of kTile pixels
  CornerShares shares{};
};

}  // namespace orbwatch::remap
