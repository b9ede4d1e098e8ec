#pragma once

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

namespace orbwatch::remap {

/// What a kernel does with a tile.
enum class TileClass : std::uint8_t {
  Blind,    ///< no pixel is on the ball's picture: filled without reading
  Outside,  ///< every pixel falls outside the source picture: filled without reading
  Patch,    ///< one smooth patch
  Dense,    ///< row by row, each pixel a coordinate or a marker
};

/// Where a tile's coordinates are kept.
enum class TileStore : std::uint8_t { Grid, OwnNodes, Split, Fine8, Fine4, Packed, Whole };

struct Tile {
  TileClass kind = TileClass::Blind;
  TileStore store = TileStore::Grid;  ///< Patch: Grid or OwnNodes; Dense: the others
  bool interior =
      false;  ///< Patch: every pixel and its right and lower neighbour are in the source
  std::uint32_t index = 0;  ///< in its store
};

/// The map from a view's pixels to one source's pixels, compiled so that the frame path needs
/// neither trigonometry nor a map of full size. Every defined pixel is within kTolerance of the
/// exact map. Immutable; reentrant.
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

  const Tile& tile(int tx, int ty) const {
    return tiles_[static_cast<std::size_t>(ty) * tiles_x_ + tx];
  }
  /// The map within a Patch tile.
  Patch patch(int tx, int ty) const;
  /// Row `y`, 0..15, of a Dense tile, with markers. Pixels beyond the view's border are undefined.
  CoordinateRow dense_row(const Tile& tile, int y) const;
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

  int width_;
  int height_;
  int source_width_;
  int source_height_;
  int tiles_x_;
  int tiles_y_;
  std::vector<Coordinate> nodes_;  ///< (tiles + 1) corners and a ring of one around them
  std::vector<Tile> tiles_;
  std::vector<Stencil> own_nodes_;
  std::vector<SplitTile> split_;
  std::vector<FineTile<8>> fine8_;
  std::vector<FineTile<4>> fine4_;
  std::vector<PackedTile> packed_;
  std::vector<WholeTile> whole_;
};

}  // namespace orbwatch::remap
