// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <span>

#include "proc/image/picture.h"
#include "proc/remap/colour/tile_conversion.h"
#include "proc/remap/grid/coordinate_grid.h"
#include "proc/remap/kernel/kernel.h"
#include "proc/remap/sampling/plane_sampler.h"
#include "proc/settings/settings.h"

namespace orbwatch::remap {

/// Method that makes a view's pixel from the source's pixels.
enum class Interpolation {
  Area,      ///< bilinear; the mean of several places where the view is smaller than the source
  Bilinear,  ///< from the four pixels around one place
  Nearest,   ///< the closest pixel
};

/// The interpolations with their names in files and options.
inline constexpr std::array kInterpolations{Word{"area", Interpolation::Area},
                                            Word{"bilinear", Interpolation::Bilinear},
                                            Word{"nearest", Interpolation::Nearest}};

/// True if remap() reads the mip levels of a source.
constexpr bool uses_mip_levels(Interpolation interpolation) {
  return interpolation == Interpolation::Area;
}

/// Samples that are taken from a source, and their use.
enum class SampledPlanes {
  All,
  Yuv420,     ///< all samples of a source that is_yuv420(), for an I420 view in kJfif
  Luminance,  ///< the Y of a Yuv source, see write_luminance()
};

/// Fills tiles of a view from one source. Refers to its arguments; reentrant.
class TileRemap {
 public:
  /// Preconditions: those of remap(); luminance is written to Grey.
  TileRemap(const CoordinateGrid& grid, std::span<const Picture> source,
            Interpolation interpolation, const Kernel& kernel,
            SampledPlanes sampled = SampledPlanes::All);

  /// Writes the tile (tx, ty), as far as it lies in the view, into `area` of `out`.
  void write(int tx, int ty, const MutablePicture& out, const TileArea& area) const;
  /// Writes a tile that is whole and defined throughout in planes, in the order `order`, Rgb or
  /// Bgr, from a source of colours.
  void write_planes(int tx, int ty, PixelFormat order, PlanarTile& out) const;
  /// Writes a row of tiles of the view `out`.
  void write_row(int ty, const MutablePicture& out) const;

 private:
  /// Targets of a tile's samples, one per sampling.
  using Targets = std::array<TargetPlane, 3>;

  Targets targets_in(const MutablePicture& out, int x, int y) const;
  Targets targets_in(SampledTile& tile) const;
  bool write_simple(int tx, int ty, const Targets& targets) const;
  void write_other(int tx, int ty, const MutablePicture& out, const TileArea& area,
                   const Targets* in_place) const;
  CoordinateTile sample_pixels(int tx, int ty, const Targets& targets) const;
  bool sample_smooth(int tx, int ty, const Targets& targets) const;
  void fetch(int tx, int ty) const;
  void fetch_targets(const Targets& targets, int tx) const;
  Reading reading(const Tile& tile) const;
  void sample(const Patch& patch, Reading reading, const Targets& targets) const;
  template <int Cell>
  void sample(const FineTile<Cell>& cells, Reading reading, const Targets& targets) const;
  void sample(const CoordinateTile& coordinates, Reading reading, const Targets& targets) const;

  const CoordinateGrid& grid_;
  const Kernel& kernel_;
  int last_level_;  ///< highest mip level of the source
  PixelFormat format_;
  ColourSpace colour_space_;
  Interpolation interpolation_;
  SampledPlanes sampled_;
  int simple_levels_;  ///< tiles below this level may be sampled in blocks, without averaging
  std::array<PlaneSampler, 3> planes_;
  std::size_t plane_count_;
};

/// The area of a tile in its view.
inline TileArea area_of(const CoordinateGrid& grid, int tx, int ty) {
  return {tx * kTile, ty * kTile, std::min(kTile, grid.width() - tx * kTile),
          std::min(kTile, grid.height() - ty * kTile)};
}

}  // namespace orbwatch::remap
