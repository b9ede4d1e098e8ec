#pragma once

#include <array>
#include <cstdint>

#include "proc/image/image_view.h"
#include "proc/image/pixel_format.h"
#include "proc/remap/grid/coordinate.h"

namespace orbwatch::remap {

/// Shows one-channel pictures in colour: 256 RGB entries spread over the values [low, high]; values
/// beyond take the first or last entry. Immutable; reentrant.
class ColourMap {
 public:
  using Table = std::array<std::array<std::uint8_t, 3>, 256>;

  /// low < high, in the picture's counts.
  ColourMap(const Table& table, double low, double high);

  /// Fills the tile rows `rows` of `out`, the size of `values`: 3 channels in the order of `order`,
  /// Rgb or Bgr, or 1 channel, the luma of the colours.
  void apply(const ImageView<const std::uint8_t>& values, const ImageView<std::uint8_t>& out,
             TileRows rows, PixelFormat order = PixelFormat::Rgb) const;
  void apply(const ImageView<const std::uint16_t>& values, const ImageView<std::uint8_t>& out,
             TileRows rows, PixelFormat order = PixelFormat::Rgb) const;

 private:
  /// Three channels as bytes in memory, and 0.
  using Colours = std::array<std::uint32_t, 256>;
  using Greys = std::array<std::uint8_t, 256>;
  /// By place in the table, or by the value of an 8 bit picture.
  struct Entries {
    Colours rgb, bgr;
    Greys grey;
  };

  std::size_t entry_of(std::int32_t value) const;

  std::int32_t low_;
  std::int32_t high_;
  std::int64_t scale_;  ///< table steps per count, Q32
  Entries entries_;
  Entries of_bytes_;
};

}  // namespace orbwatch::remap
