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

  bool write_patch(const Patch& patch, const Minification& small, const MutablePicture& out,
                   const TileArea& area) const;
  bool fill(const Patch& patch, const Minification& small, std::size_t sampling,
            const TargetPlane& target) const;
  bool sample(const Patch& patch, Layout layout, const SourcePlane& source,
              const TargetPlane& target) const;
  bool sample_blocks(const Patch& patch, Layout layout, const SourcePlane& source,
                     const TargetPlane& target) const;
  bool sample_steep(const Patch& patch, Layout layout, const SourcePlane& source,
                    const TargetPlane& target) const;
  bool sample_oversampled(const Patch& patch, Layout layout, const SourcePlane& source,
                          const TargetPlane& target) const;
  void write_dense(int tx, int ty, const Minification& small, const MutablePicture& out,
                   const TileArea& area) const;

  const CoordinateGrid& grid_;
  int halves_;  ///< of the source that there are
  PixelFormat format_;
  ColourSpace colour_space_;
  Interpolation interpolation_;
  const Kernel& kernel_;
  SamplingList samplings_;
  /// By how often the source was halved, and by sampling.
  std::array<std::array<SourcePlane, 3>, kMaxLevel> sources_;
};

/// Where a tile lies in its view.
inline TileArea area_of(const CoordinateGrid& grid, int tx, int ty) {
  return {tx * kTile, ty * kTile, std::min(kTile, grid.width() - tx * kTile),
          std::min(kTile, grid.height() - ty * kTile)};
}

}  // namespace orbwatch::remap
