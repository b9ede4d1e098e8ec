#pragma once

#include <array>
#include <span>

#include "proc/image/picture.h"
#include "proc/remap/coordinate_grid.h"
#include "proc/remap/kernel.h"
#include "proc/remap/plane_sampler.h"
#include "proc/remap/tile_conversion.h"

namespace orbwatch::remap {

/// How a pixel of a view is made from those of the source.
enum class Interpolation {
  Area,      ///< bilinear; the mean of several places where the view is smaller than the source
  Bilinear,  ///< from the four around one place
  Nearest,   ///< the closest one
};

/// Fills tiles of a view from one source. Holds references only; reentrant.
class TileRemap {
 public:
  /// See remap() for what these must be.
  TileRemap(const CoordinateGrid& grid, std::span<const Picture> source,
            Interpolation interpolation, const Kernel& kernel);

  /// Writes the tile (tx, ty), as far as it lies in the view, into `area` of `out`.
  void write(int tx, int ty, const MutablePicture& out, const TileArea& area) const;
  /// Writes a row of tiles of the view `out`.
  void write_row(int ty, const MutablePicture& out) const;

 private:
  /// Where a tile's samples go, by sampling.
  using Targets = std::array<TargetPlane, 3>;

  Halves halves(int level) const;
  Targets targets_in(const MutablePicture& out, int x, int y) const;
  Targets targets_in(SampledTile& tile) const;
  void write_tile_at(int tx, int ty, const MutablePicture& out, const TileArea& area,
                     const Targets* in_place) const;
  bool sample(const Patch& patch, Halves halves, const Targets& targets) const;
  bool write_converted(const Patch& patch, Halves halves, const MutablePicture& out,
                       const TileArea& area) const;
  void write_dense(int tx, int ty, Halves halves, const MutablePicture& out,
                   const TileArea& area) const;

  const CoordinateGrid& grid_;
  int most_halves_;  ///< of the source that there are
  PixelFormat format_;
  ColourSpace colour_space_;
  Interpolation interpolation_;
  std::array<PlaneSampler, 3> planes_;
  std::size_t plane_count_;
};

/// Where a tile lies in its view.
inline TileArea area_of(const CoordinateGrid& grid, int tx, int ty) {
  return {tx * kTile, ty * kTile, std::min(kTile, grid.width() - tx * kTile),
          std::min(kTile, grid.height() - ty * kTile)};
}

}  // namespace orbwatch::remap
