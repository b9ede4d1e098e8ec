// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "proc/image/image_view.h"
#include "proc/optics/ball_projection.h"
#include "proc/optics/view_projection.h"
#include "proc/remap/grid/coordinate.h"
#include "proc/remap/grid/patch.h"
#include "proc/remap/grid/source_area.h"
#include "proc/remap/grid/tile.h"
#include "proc/remap/grid/tile_stores.h"

namespace orbwatch::remap {

/// The map from a view's pixels to one source's pixels, compiled so that the frame path needs
/// neither trigonometry nor a map of full size. Every defined pixel is within kTolerance of the
/// exact map, in pixels of its tile's mip level, by an estimate from its nodes; in unusual views
/// (with few pixels, close to the limb) the estimate was up to 1.6 times too low. Immutable;
/// reentrant.
class CoordinateGrid {
 public:
  /// Evaluates the exact map at the tiles' corners, and more densely in tiles that an edge of the
  /// scene crosses or whose patch would not be close enough. Allocates; not for the frame path.
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
  /// The highest mip level of all tiles.
  int levels() const { return levels_; }
  /// The mip levels of a Pyramid that remap() can use: it averages the last factor of two itself.
  int pyramid_levels() const { return std::max(levels_ - 1, 0); }
  /// The nodes of the tile `tile` at (tx, ty), whose kind is_patch().
  PatchNodes nodes(const Tile& tile, int tx, int ty) const {
    if (tile.kind == TileKind::OwnPatch) return {&own_nodes_[tile.index].at(0, 0), 4};
    return {&node(tx, ty), tiles_x_ + 3};
  }
  /// Calls `visit` with the cells of a tile, as FineTile<8> or FineTile<4>; false for a tile
  /// without.
  template <class Visit>
  bool visit_cells(const Tile& tile, const Visit& visit) const;
  /// All rows of any tile, with markers; faster than row by row. Pixels beyond the view's border
  /// are undefined.
  CoordinateTile pixels(int tx, int ty) const;
  /// Row `y`, 0..15, of any tile.
  CoordinateRow row(int tx, int ty, int y) const;

  /// The area of the source that holds every pixel that remap() reads for this view, neighbours for
  /// interpolation and shared chroma included. Decodes tiles; not for the frame path.
  SourceArea sampled_area() const;

  /// The approximate area of a tile in the source: the rectangle around its corners. Empty when the
  /// map has no place for one of them, or beyond the last tile. For the frame path.
  SourceArea extent(int tx, int ty) const {
    if (tx >= tiles_x_ || ty >= tiles_y_) return {};
    const Coordinate &a = node(tx, ty), &b = node(tx + 1, ty), &c = node(tx, ty + 1),
                     &d = node(tx + 1, ty + 1);
    const auto [left, right] = std::minmax({a.u, b.u, c.u, d.u});
    const auto [top, bottom] = std::minmax({a.v, b.v, c.v, d.v});
    if (left <= kOutside) return {};
    const SourceArea area{left >> kFractionBits, top >> kFractionBits, (right >> kFractionBits) + 2,
                          (bottom >> kFractionBits) + 2};
    return common(area, {0, 0, source_width_, source_height_});
  }

  /// Writes one Validity per pixel into `out`, which has the view's size.
  void write_validity(const ImageView<std::uint8_t>& out) const;

  /// Memory of the map in bytes.
  std::size_t bytes() const;

 private:
  class Compiler;

  const Coordinate& node(int i, int j) const {
    return nodes_[static_cast<std::size_t>(j + 1) * (tiles_x_ + 3) + (i + 1)];
  }
  Stencil stencil(int tx, int ty) const;
  SourceArea sampled_area(int tx, int ty) const;
  void write_validity(int tx, int ty, const ImageView<std::uint8_t>& out) const;
  FineTile<8> curved(const Tile& tile) const;

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
  PixelTiles pixel_tiles_;
};

template <class Visit>
bool CoordinateGrid::visit_cells(const Tile& tile, const Visit& visit) const {
  if (tile.kind == TileKind::Curved) {
    visit(curved(tile));
  } else if (tile.kind == TileKind::Fine) {
    visit(fine_[tile.index]);
  } else if (tile.kind == TileKind::CurvedFine) {
    visit(curved_tile(fine_[tile.index]));
  } else {
    return false;
  }
  return true;
}

}  // namespace orbwatch::remap
