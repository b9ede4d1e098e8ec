#pragma once

#include <span>

#include "proc/image/picture.h"
#include "proc/remap/coordinate_grid.h"
#include "proc/remap/dense_sampling.h"
#include "proc/remap/kernel.h"
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

 private:
  /// What is done in a tile where the view is smaller than the source.
  struct Minification {
    int halves = 0;            ///< how often the source is halved
    bool oversampled = false;  ///< pixels are means of four samples
  };
  Minification minification(int level) const;

  /// A sampling of the source's format, with what all tiles need for it.
  struct Plane {
    PlaneSampling sampling;
    Kernel::Tile kernel = nullptr;               ///< if there is one for its layout
    AxisPair<std::int32_t> added;                ///< to coordinates, Q13, see BlockMap::make()
    int columns, rows, out_bytes;                ///< of a tile, and of its pixels
    std::array<SourcePlane, kMaxLevel> sources;  ///< by how often the source was halved
  };

  bool write_patch(Patch patch, const Minification& small, const MutablePicture& out,
                   const TileArea& area) const;
  bool write_converted(Patch patch, const Minification& small, const MutablePicture& out,
                       const TileArea& area) const;
  template <class TargetOf>
  bool sample_planes(Patch patch, const Minification& small, const TargetOf& target_of) const;
  static bool sample(Patch patch, const Plane& plane, const SourcePlane& source,
                     TargetPlane target);
  static bool sample_blocks(Patch patch, const Plane& plane, const SourcePlane& source,
                            TargetPlane target);
  static bool sample_steep(Patch patch, const Plane& plane, const SourcePlane& source,
                           TargetPlane target);
  static bool sample_oversampled(Patch patch, const Plane& plane, const SourcePlane& source,
                                 TargetPlane target);
  static TargetPlane plane_of_view(const MutablePicture& out, const Plane& plane,
                                   const TileArea& area);
  static TargetPlane plane_of(SampledTile& sampled, std::size_t n, const Plane& plane);
  void write_dense(int tx, int ty, const Minification& small, const MutablePicture& out,
                   const TileArea& area) const;

  const CoordinateGrid& grid_;
  int halves_;  ///< of the source that there are
  PixelFormat format_;
  ColourSpace colour_space_;
  Interpolation interpolation_;
  std::array<Plane, 3> planes_;
  std::size_t plane_count_;
};

/// Where a tile lies in its view.
inline TileArea area_of(const CoordinateGrid& grid, int tx, int ty) {
  return {tx * kTile, ty * kTile, std::min(kTile, grid.width() - tx * kTile),
          std::min(kTile, grid.height() - ty * kTile)};
}

}  // namespace orbwatch::remap
