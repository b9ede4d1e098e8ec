#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "proc/image/image_view.h"
#include "proc/image/validity.h"
#include "proc/optics/ball_projection.h"
#include "proc/optics/view_projection.h"
#include "proc/remap/coordinate.h"
#include "proc/remap/dense_tile.h"
#include "proc/remap/patch.h"
#include "proc/remap/tile_table.h"

namespace orbwatch::remap {

/// The map from a view's pixels to one source's pixels, compiled so that the frame path needs
/// neither trigonometry nor a map of full size. Every defined pixel is within kTolerance of the
/// exact map by an estimate from its nodes, which in odd views (of few pixels, close to the limb)
/// was found to be 1.6 times too low. Immutable; reentrant.
class CoordinateGrid {
 public:
  /// Evaluates the exact map at the tiles' corners; tiles whose patch would not be close enough, or
  /// that an edge of the scene crosses, go dense. Allocates; not for the frame path.
  CoordinateGrid(const optics::ViewProjection& view, const optics::BallProjection& ball,
                 int source_width, int source_height);

  int width() const { return width_; }
  int height() const { return height_; }
  int source_width() const { return source_width_; }
  int source_height() const { return source_height_; }
  int tiles_x() const { return tiles_x_; }
  int tiles_y() const { return tiles_y_; }

  Tile tile(int tx, int ty) const {
    return tiles_[static_cast<std::size_t>(ty) * static_cast<std::size_t>(tiles_x_) +
                  static_cast<std::size_t>(tx)];
  }
  /// The highest level that any tile asks for.
  int levels() const { return levels_; }
  /// How many halves of the source remap() can use: the last factor of two it samples itself.
  int halves() const { return std::max(levels_ - 1, 0); }
  /// What the map within the Patch tile `tile` at (tx, ty) is made from.
  PatchNodes nodes(const Tile& tile, int tx, int ty) const {
    if (tile.store == TileStore::OwnNodes) return {&own_nodes_[tile.index].at(0, 0), 4};
    return {&node(tx, ty), tiles_x_ + 3};
  }
  /// Hands a tile that is kept as finer patches to `take`, as FineTile<8> or FineTile<4>; false for
  /// others.
  template <class Take>
  bool take_cells(const Tile& tile, const Take& take) const;
  /// All rows of any tile, with markers, in less time than one by one. Pixels beyond the view's
  /// border are undefined.
  CoordinateTile pixels(int tx, int ty) const;
  /// Row `y`, 0..15, of any tile: for where speed matters less than simplicity.
  CoordinateRow row(int tx, int ty, int y) const;

  /// One Validity per pixel into `out`, which has the view's size.
  void write_validity(const ImageView<std::uint8_t>& out) const;

  /// Memory of the map in bytes.
  std::size_t bytes() const;

 private:
  class Compiler;

  const Coordinate& node(int i, int j) const {
    return nodes_[static_cast<std::size_t>(j + 1) * (tiles_x_ + 3) + (i + 1)];
  }
  Stencil stencil(int tx, int ty) const;
  void write_validity(int tx, int ty, const ImageView<std::uint8_t>& out) const;
  FineTile<8> curved(const Tile& tile) const;
  CoordinateRow dense_row(const Tile& tile, int y) const;

  int width_;
  int height_;
  int source_width_;
  int source_height_;
  int tiles_x_;
  int tiles_y_;
  int levels_ = 0;
  std::vector<Coordinate> nodes_;  ///< (tiles + 1) corners and a ring of one around them
  TileTable tiles_;
  std::vector<Stencil> own_nodes_;
  std::vector<SplitTile> split_;
  std::vector<FineTile<8>> fine_;
  std::vector<PackedTile> packed_;
  std::vector<WholeTile> whole_;
};

template <class Take>
bool CoordinateGrid::take_cells(const Tile& tile, const Take& take) const {
  if (tile.store == TileStore::Curved) {
    take(curved(tile));
  } else if (tile.store == TileStore::Fine) {
    take(fine_[tile.index]);
  } else if (tile.store == TileStore::CurvedFine) {
    take(curved_tile(fine_[tile.index]));
  } else {
    return false;
  }
  return true;
}

}  // namespace orbwatch::remap
