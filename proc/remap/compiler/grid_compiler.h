// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <optional>
#include <vector>

#include "proc/remap/compiler/edge_mask.h"
#include "proc/remap/compiler/exact_map.h"
#include "proc/remap/compiler/plain_tiles.h"
#include "proc/remap/grid/coordinate_grid.h"

namespace orbwatch::remap {

/// Fills a grid from the exact map. The map is smooth on each surface of the scene, also slightly
/// beyond the surface's edges, so that patches reach the edges from either side. Tiles beyond the
/// accuracy of patches are evaluated pixel by pixel.
class CoordinateGrid::Compiler {
 public:
  Compiler(CoordinateGrid& grid, const optics::ViewProjection& view,
           const optics::BallProjection& ball);

  void run();

 private:
  /// A tile and its surface.
  struct Place {
    int tx, ty;
    int surface;
    bool uniform;  ///< the grid's nodes around it are on that surface too
  };
  using Surfaces = std::array<std::array<int, kTile>, kTile>;

  std::size_t index(int i, int j) const {
    return static_cast<std::size_t>(j + 1) * (grid_.tiles_x_ + 3) + (i + 1);
  }
  int columns(int tx) const { return std::min(kTile, grid_.width_ - tx * kTile); }
  int rows(int ty) const { return std::min(kTile, grid_.height_ - ty * kTile); }

  std::size_t tile_number(int tx, int ty) const {
    return static_cast<std::size_t>(ty) * static_cast<std::size_t>(grid_.tiles_x_) +
           static_cast<std::size_t>(tx);
  }

  void evaluate_nodes();
  void compile_run(int tx, int ty, const PlainTiles::Levels& levels);
  Tile compile(int tx, int ty);
  bool is_in_projection(int tx, int ty) const;
  bool is_uniform(int tx, int ty) const;
  bool is_blind(int tx, int ty) const;
  Surfaces surfaces_of(int tx, int ty) const;

  Tile tile_on_surface(const Place& place);
  Tile tile_of_surfaces(int tx, int ty, const Surfaces& surfaces);
  std::optional<Tile> split_tile(int tx, int ty, const Surfaces& surfaces);
  std::optional<Tile> fine_tile(const Place& place);
  bool follows_the_map(const CoordinateTile& pixels, const Place& place, int level) const;
  std::optional<Tile> curved_tile(const Stencil& nodes, const Place& place);
  std::optional<Tile> fitted_tile(const FineTile<8>& curve, double fourth, const Place& place);
  template <int Cell>
  std::optional<Tile> tile_of_cells(TileKind kind, const FineTile<Cell>& fine, double fourth) const;
  Tile pixel_tile(int tx, int ty, const Surfaces& surfaces);
  void own_nodes(Tile& tile, const Stencil& nodes);
  std::optional<Tile> patch_tile(const Stencil& nodes, int tx, int ty) const;

  std::optional<Stencil> stencil(const Place& place);
  Coordinate extended_node(int surface, int i, int j);
  bool is_close(const Stencil& stencil, const Place& place, int level) const;
  double fourth_order_part(const Stencil& stencil, const Place& place) const;
  double curve_error(const Place& place) const;
  bool is_inside(const Patch& patch, int level) const;
  bool is_interior(const Patch& patch, int level) const;

  CoordinateGrid& grid_;
  ExactMap map_;
  PlainTiles plain_;
  EdgeMask edges_;
  bool edges_are_known_;  ///< true if all edges are in `edges_`
  bool is_smooth_;  ///< true if smooth on each surface; else the map is evaluated at every pixel
  bool nodes_are_close_;       ///< neighbouring nodes are within some degrees of each other
  std::vector<int> surfaces_;  ///< surfaces of the nodes, in their order
  std::vector<std::vector<Coordinate>> extended_;  ///< nodes of each surface, also beyond its edges
};

}  // namespace orbwatch::remap
