// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <optional>

#include "proc/image/image_view.h"
#include "proc/image/picture.h"
#include "proc/remap/colour/planar_tile.h"
#include "proc/remap/grid/coordinate_grid.h"
#include "proc/remap/merge/merged_remap.h"
#include "proc/remap/sampling/tile_remap.h"

namespace orbwatch::remap {

template <class T>
ImageView<T> part(const ImageView<T>& picture, const TileArea& area) {
  return {picture.at(area.x, area.y), area.columns, area.rows, picture.channels, picture.stride};
}

/// A tile with memory of its own.
template <class T, int Channels>
struct TilePicture {
  alignas(64) std::array<T, kTile * kTile * Channels> samples;

  ImageView<T> view() { return {samples.data(), kTile, kTile, Channels, kTile * Channels}; }
};

/// The tiles of one source for a view, and its measured plane. Refers to its arguments; reentrant.
class SourceTiles {
 public:
  /// `view`: the format of the merged view.
  SourceTiles(const MergedSource& source, PixelFormat view, Interpolation interpolation,
              const Kernel& kernel);

  /// sees(): the source may show something in the tile. fills(): it shows all of the tile.
  bool sees(int tx, int ty) const { return !is_empty(source_.grid->tile(tx, ty).kind); }
  bool fills(int tx, int ty) const {
    return is_defined_throughout(source_.grid->tile(tx, ty).kind);
  }

  /// True if write_yuv420() is possible, which writes a tile into an I420 picture of the view's
  /// colour space without a detour by R'G'B': the source has 4:2:0 in BT.601 and keeps its
  /// exposure, or is mapped to colours.
  bool writes_yuv420() const { return writes_yuv420_; }
  void write_yuv420(int tx, int ty, const MutablePicture& out, const TileArea& area) const;

  /// Writes a tile into `area` of `out`, which has the view's format, or Rgb for an I420 view; also
  /// writes its measured plane.
  void write(int tx, int ty, const MutablePicture& out, const TileArea& area) const;

  /// The same for a whole tile that the source fills(), in planes; by a kernel with mix_planes.
  void write_planes(int tx, int ty, PlanarTile& out) const;

  /// Writes only the measured plane of a tile, if it is to be written.
  void measure(int tx, int ty) const;

  static bool is_measured(const MergedSource& source) {
    return source.measured.planes[0].data != nullptr;
  }
  /// True if the source's measured plane is to be written.
  static bool is_to_measure(const MergedSource& source) {
    return is_measured(source) && !source.is_measured_before;
  }

 private:
  SampledPlanes luminance() const;
  template <class T>
  void write_mapped(int tx, int ty, const MutablePicture& out, const TileArea& area) const;
  template <class T>
  void write_mapped_planes(int tx, int ty, PlanarTile& out) const;
  template <class T>
  void write_mapped_yuv420(int tx, int ty, const MutablePicture& out, const TileArea& area) const;
  template <class T>
  ImageView<T> values_of(int tx, int ty, TilePicture<T, 1>& tile) const;

  const MergedSource& source_;
  const Kernel& kernel_;
  PixelFormat format_;
  PixelFormat order_;  ///< Rgb or Bgr, of the view's channels
  ColourModel colour_;
  bool is_wide_;    ///< 16 bit
  bool is_mapped_;  ///< one channel is mapped to colours
  bool is_dimmed_;  ///< colours are reduced to luma
  bool writes_yuv420_;
  TileRemap tiles_;
  std::optional<TileRemap> yuv420_tiles_;    ///< set if a YUV source writes_yuv420()
  std::optional<TileRemap> measured_tiles_;  ///< set if the measured plane is to be written
};

}  // namespace orbwatch::remap
