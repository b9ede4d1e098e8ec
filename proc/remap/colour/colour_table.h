// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <bit>
#include <cstddef>
#include <cstdint>
#include <cstring>

namespace orbwatch::remap {

/// A lookup table of 256 colours of one or three channels, in the layouts that processors read
/// fastest.
struct ColourTable {
  int channels = 3;
  /// One table per channel, for processors that hold them in registers.
  alignas(64) std::array<std::array<std::uint8_t, 256>, 3> planes{};
  /// Three channels as bytes in memory, and 0.
  std::array<std::uint32_t, 256> words{};

  void set(std::size_t entry, const std::array<std::uint8_t, 3>& colour) {
    for (std::size_t k = 0; k < planes.size(); ++k) planes[k][entry] = colour[k];
    words[entry] =
        std::bit_cast<std::uint32_t>(std::array<std::uint8_t, 4>{colour[0], colour[1], colour[2]});
  }

  /// Looks up at least one pixel.
  [[gnu::always_inline]] void look_up(const std::uint8_t* indices, int columns,
                                      std::uint8_t* out) const {
    if (channels == 1) {
      for (int x = 0; x < columns; ++x) out[x] = planes[0][indices[x]];
      return;
    }
    // Writes whole words, each over the unused byte of the one before.
    for (int x = 0; x < columns - 1; ++x) std::memcpy(out + 3 * x, &words[indices[x]], 4);
    std::memcpy(out + 3 * (columns - 1), &words[indices[columns - 1]], 3);
  }
};

/// Fraction bits of an entry's number before it is rounded.
inline constexpr int kEntryBits = 7;
inline constexpr std::uint16_t kHalfEntry = 1 << (kEntryBits - 1);

/// Mapping of 16 bit values to a table: entry (((value in [low, high]) - low) unit scale >> 16 +
/// kHalfEntry) >> kEntryBits.
struct ValueScale {
  std::uint16_t low, high;
  std::uint16_t unit;   ///< brings high - low to 16 bits
  std::uint16_t scale;  ///< entries per unit, with 16 + kEntryBits fraction bits
};

/// Runs of indices into a table, at most kTile of them, `stride` bytes apart.
struct IndexRuns {
  const std::uint8_t* first;
  std::ptrdiff_t stride;
  int rows;
};

}  // namespace orbwatch::remap
