#pragma once

#include <array>
#include <cstdint>

#include "proc/image/image_view.h"
#include "proc/remap/grid/coordinate.h"

namespace orbwatch::remap {

/// Shows one-channel pictures in colour: 256 RGB entries spread over the values [low, high]; values
/// beyond take the first or last entry. Immutable; reentrant.
class ColourMap {
 public:
  using Table = std::array<std::array<std::uint8_t, 3>, 256>;

  /// low < high, in the picture's counts.
  ColourMap(const Table& table, double low, double high);

  /// Fills the tile rows `rows` of `rgb` (3 channels, the size of `values`).
  void apply(const ImageView<const std::uint8_t>& values, const ImageView<std::uint8_t>& rgb,
             TileRows rows) const;
  void apply(const ImageView<const std::uint16_t>& values, const ImageView<std::uint8_t>& rgb,
             TileRows rows) const;

 private:
  /// As bytes red, green, blue, 0 in memory.
  using Entry = std::uint32_t;

  std::size_t entry_of(std::int32_t value) const;

  std::int32_t low_;
  std::int32_t high_;
  std::int64_t scale_;  ///< table steps per count, Q32
  std::array<Entry, 256> entries_;
  std::array<Entry, 256> of_bytes_;  ///< by the value of an 8 bit picture
};

}  // namespace orbwatch::remap
