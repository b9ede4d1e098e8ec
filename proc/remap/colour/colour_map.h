// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstdint>

#include "proc/image/image_view.h"
#include "proc/image/pixel_format.h"
#include "proc/remap/colour/colour_table.h"
#include "proc/remap/colour/planar_tile.h"
#include "proc/remap/colour/yuv420_tile.h"
#include "proc/remap/grid/coordinate.h"
#include "proc/remap/kernel/kernel.h"

namespace orbwatch::remap {

/// Converts one-channel pictures to colour: 256 RGB entries spread over the values [low, high];
/// values beyond get the first or last entry. Immutable; reentrant.
class ColourMap {
 public:
  using Table = std::array<std::array<std::uint8_t, 3>, 256>;

  /// Precondition: low < high, in the picture's counts.
  ColourMap(const Table& table, double low, double high);

  /// Fills `out`, the size of `values`, at most kTile each way: 3 channels in the order of `order`,
  /// Rgb or Bgr, or 1 channel, the luma of the colours.
  void apply(const ImageView<const std::uint8_t>& values, const ImageView<std::uint8_t>& out,
             const Kernel& kernel, PixelFormat order = PixelFormat::Rgb) const;
  void apply(const ImageView<const std::uint16_t>& values, const ImageView<std::uint8_t>& out,
             const Kernel& kernel, PixelFormat order = PixelFormat::Rgb) const;

  /// The same for a whole tile in planes, by a kernel that has look_up_planes.
  void apply(const ImageView<const std::uint8_t>& values, PlanarTile& out, const Kernel& kernel,
             PixelFormat order) const;
  void apply(const ImageView<const std::uint16_t>& values, PlanarTile& out, const Kernel& kernel,
             PixelFormat order) const;

  /// The same in I420 of kJfif, for a whole tile; where `values` are less, the rest of `out` has no
  /// meaning. Each colour's Y, U and V are rounded before the mean chroma of two by two pixels is.
  void apply(const ImageView<const std::uint8_t>& values, const Yuv420Planes& out,
             const Kernel& kernel) const;
  void apply(const ImageView<const std::uint16_t>& values, const Yuv420Planes& out,
             const Kernel& kernel) const;

 private:
  /// Colours by index in the table, or by the value of an 8 bit picture.
  struct Entries {
    ColourTable rgb, bgr;
    ColourTable yuv{1};  ///< Y alone is looked up as one channel
  };
  /// Runs of indices in a tile.
  struct Indices {
    IndexRuns runs() const { return {entries.data(), kRun, kTile}; }

    alignas(64) std::array<std::uint8_t, kRun * kTile> entries;
  };

  static const ColourTable& table(const Entries& entries, int channels, PixelFormat order);
  std::size_t entry_of(std::int32_t value) const;
  void find(const ImageView<const std::uint16_t>& values, Indices& indices,
            const Kernel& kernel) const;

  std::int32_t low_;
  std::int32_t high_;
  int shift_;            ///< brings high_ - low_ to 16 bits; lower bits are cut
  std::uint16_t scale_;  ///< entries per shifted count, with 16 + kEntryBits fraction bits
  Entries entries_;
  Entries of_bytes_;
};

}  // namespace orbwatch::remap
