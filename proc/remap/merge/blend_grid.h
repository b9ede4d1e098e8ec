// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "proc/optics/ball_projection.h"
#include "proc/optics/view_projection.h"
#include "proc/remap/grid/coordinate_grid.h"
#include "proc/remap/kernel/mixed_tile.h"
#include "proc/remap/merge/merge.h"

namespace orbwatch::remap {

/// One source of a view, for its weights.
struct BlendSource {
  const optics::BallProjection& ball;
  int source_width = 0;  ///< size of its picture, px
  int source_height = 0;
  double weight = 1;  ///< the user's factor, above 0
  /// Pixels per degree above which resolution no longer counts, so that the weight alone decides
  /// wherever the source sees well; nullopt: resolution decides everywhere.
  std::optional<double> enough;
};

/// The weights of a tile's pixels for one source, in rows of kTile.
using TileWeights = std::array<std::uint8_t, kTile * kTile>;

/// The shares of up to kMaxSources sources in each pixel of a view, kept at the corners of the
/// view's tiles.
///
/// A source has weight (pixels per degree there)^4, or weight min(1, pixels per degree / enough)^4,
/// and fades out towards the border of its picture where that cuts the ball; towards the limb its
/// resolution does so by itself. So the sharper camera dominates, or the user's shares hold, and no
/// seam shows where one of them begins or ends. At each corner that some source sees these are
/// scaled to add up to 255, in whole numbers; between corners they are interpolated linearly, so
/// they add up to less beside corners that none sees (merge() divides by the sum). Immutable;
/// reentrant.
class BlendGrid {
 public:
  /// Allocates; not for the frame path.
  BlendGrid(const optics::ViewProjection& view, std::span<const BlendSource> sources);

  /// The shares of source `n` in a tile.
  CornerShares corners(std::size_t n, int tx, int ty) const;
  /// The sources that have a share in the tile; any other counts only where these see nothing.
  SourceSet sharing(int tx, int ty) const { return tiles_[tile(tx, ty)].sharing; }
  /// True if each corner of the tile is seen by some source, so that the shares add up to 255.
  bool adds_up(int tx, int ty) const { return tiles_[tile(tx, ty)].adds_up; }

  /// The weights of source `n`, whose map is `grid`, in a tile: 0 where its pixels are undefined,
  /// else at least 1, so that a weak source alone is enough when others do not deliver.
  void weights(std::size_t n, const CoordinateGrid& grid, int tx, int ty, TileWeights& out) const;

  /// The weights of all tiles, in a plane of the view's size.
  void weights(std::size_t n, const CoordinateGrid& grid, const ImageView<std::uint8_t>& out) const;

  /// Memory in bytes.
  std::size_t bytes() const;

 private:
  struct TileShares {
    SourceSet sharing = 0;
    bool adds_up = true;
  };

  std::size_t tile(int tx, int ty) const {
    return static_cast<std::size_t>(ty) * (nodes_x_ - 1) + tx;
  }
  TileShares tile_shares(int tx, int ty) const;

  int nodes_x_;
  std::vector<std::vector<std::uint8_t>> shares_;  ///< per source: rows of nodes_x_ corners
  std::vector<TileShares> tiles_;
};

}  // namespace orbwatch::remap
