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
  /// Writes a row of tiles of the view `out`.
  void write_row(int ty, const MutablePicture& out) const;

 private:
  /// What is done where the view is smaller than the source: the pixels of a tile are means of four
  /// samples of a source that was halved so often; or kPlain, they are single samples of the
  /// source.
  using Halves = int;
  static constexpr Halves kPlain = -1;
  Halves halves(int level) const;

  /// A sampling of the source's format, with what all tiles need for it.
  struct Plane {
    PlaneSampling sampling;
    Kernel::Tile kernel = nullptr;               ///< if there is one for its layout
    Both rounding{};                             ///< see BlockMap
    int columns, rows, out_bytes;                ///< of a tile, and of its pixels
    std::array<SourcePlane, kMaxLevel> sources;  ///< by how often the source was halved
  };

  void write_tile_at(int tx, int ty, bool in_place, const MutablePicture& out,
                     const TileArea& area) const;
  bool write_converted(const Patch& patch, Halves halves, const MutablePicture& out,
                       const TileArea& area) const;
  template <class TargetOf>
  bool sample_planes(const Patch& patch, Halves halves, const TargetOf& target_of) const;
  static bool sample_blocks(const Patch& patch, const Plane& plane, const SourcePlane& source,
                            const TargetPlane& target);
  static bool sample_finely(const Patch& patch, const Plane& plane, Halves halves,
                            const TargetPlane& target);
  static bool sample_steep(const Patch& patch, const Plane& plane, const SourcePlane& source,
                           const TargetPlane& target);
  static TargetPlane plane_of_view(const MutablePicture& out, const Plane& plane,
                                   const TileArea& area);
  static TargetPlane plane_of(SampledTile& sampled, std::size_t n, const Plane& plane);
  void write_dense(int tx, int ty, Halves halves, const MutablePicture& out,
                   const TileArea& area) const;

  const CoordinateGrid& grid_;
  int most_halves_;  ///< of the source that there are
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
