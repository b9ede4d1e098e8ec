// SPDX-License-Identifier: Apache-2.0
// Tiles that lie on one smooth surface.

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "proc/remap/compiler/fitted_patch.h"
#include "proc/remap/compiler/grid_compiler.h"
#include "proc/remap/compiler/mip_level.h"
#include "proc/remap/compiler/tolerance.h"

namespace orbwatch::remap {
namespace {

// Marks a node that has not been evaluated on a surface yet.
constexpr std::int32_t kUnknown = kOutside + 1;
constexpr double kUnknownError = std::numeric_limits<double>::infinity();

/// Bound of the fourth-order error: the sum of the largest along each axis.
double fourth_order_error(const FineTile<8>& fine) {
  double along_u = 0, along_v = 0;
  // The outer rows end at corners that are not used.
  for (int line = 1; line + 1 < fine.kNodes; ++line) {
    std::array<Coordinate, 5> column;
    for (int k = 0; k < fine.kNodes; ++k) column[k] = fine.nodes[k][line];
    along_u = std::max(along_u, fourth_order_error(fine.nodes[line]));
    along_v = std::max(along_v, fourth_order_error(column));
  }
  return along_u + along_v;
}

/// The part that a Coons patch omits between its four curves: at most 1/64 of the mixed fourth
/// difference about a node, `at(i, j)` being the nodes around it.
template <class At>
double mixed_error(const At& at) {
  double u = 0, v = 0;
  for (int j = -1; j <= 1; ++j) {
    for (int i = -1; i <= 1; ++i) {
      const double weight = (i == 0 ? -2 : 1) * (j == 0 ? -2 : 1);
      u += weight * at(i, j).u;
      v += weight * at(i, j).v;
    }
  }
  return std::sqrt(u * u + v * v) / 64;
}

/// The error in the middle of each side and of the tile, away from corners that are not used.
double mixed_error(const FineTile<8>& fine) {
  double error = 0;
  for (const auto& [x, y] : {std::pair{2, 2}, {1, 2}, {3, 2}, {2, 1}, {2, 3}}) {
    const auto at = [&, i0 = x, j0 = y](int i, int j) { return fine.nodes[j0 + j][i0 + i]; };
    error = std::max(error, mixed_error(at));
  }
  return error;
}

}  // namespace

Tile CoordinateGrid::Compiler::tile_on_surface(const Place& place) {
  const auto nodes = stencil(place);
  if (nodes && is_close(*nodes, place, level_of(*nodes))) {
    auto tile = patch_tile(*nodes, place.tx, place.ty);
    if (tile && tile->kind == TileKind::Patch && !place.uniform) own_nodes(*tile, *nodes);
    if (tile) return *tile;
  } else {
    if (nodes && place.uniform) {
      if (const auto tile = curved_tile(*nodes, place)) return *tile;
    }
    if (const auto tile = fine_tile(place)) return *tile;
  }
  Surfaces surfaces;
  for (auto& row : surfaces) row.fill(place.surface);
  return pixel_tile(place.tx, place.ty, surfaces);
}

/// Makes a Patch tile one on nodes of its own.
void CoordinateGrid::Compiler::own_nodes(Tile& tile, const Stencil& nodes) {
  tile.kind = TileKind::OwnPatch;
  tile.index = static_cast<std::uint32_t>(grid_.own_nodes_.size());
  grid_.own_nodes_.push_back(nodes);
}

/// A Patch tile, or an Outside one; nullopt when the source picture's border runs through it.
std::optional<Tile> CoordinateGrid::Compiler::patch_tile(const Stencil& nodes, int tx,
                                                         int ty) const {
  const Patch patch(nodes);
  const int level = level_of(nodes);
  const SourceExtent u(grid_.source_width_, level), v(grid_.source_height_, level);
  const auto [low, high] = patch.range();
  Tile tile;
  if (u.surely_misses(low.u, high.u) || v.surely_misses(low.v, high.v)) {
    tile.kind = TileKind::Outside;
    return tile;
  }
  tile.kind = TileKind::Patch;
  tile.level = static_cast<std::uint8_t>(level);
  tile.interior = is_interior(patch, level);
  if (tile.interior || is_inside(patch, level)) return tile;
  // The part in the view may be inside although the patch is not.
  for (int y = 0; y < rows(ty); ++y) {
    PatchRow row = patch.row(y);
    for (int x = 0; x < columns(tx); ++x, row.step()) {
      const Coordinate c = row.current();
      if (!u.surely_holds(c.u, c.u) || !v.surely_holds(c.v, c.v)) return std::nullopt;
    }
  }
  return tile;
}

bool CoordinateGrid::Compiler::is_interior(const Patch& patch, int level) const {
  const auto [low, high] = patch.range();
  return remap::is_interior(low.u, high.u, grid_.source_width_, level) &&
         remap::is_interior(low.v, high.v, grid_.source_height_, level);
}

bool CoordinateGrid::Compiler::is_inside(const Patch& patch, int level) const {
  const auto [low, high] = patch.range();
  return SourceExtent(grid_.source_width_, level).surely_holds(low.u, high.u) &&
         SourceExtent(grid_.source_height_, level).surely_holds(low.v, high.v);
}

/// A tile whose map a third-order curve through the grid's nodes follows: the patch that fits the
/// curve best, if it is close, else the curve in cells. nullopt when neither is close or inside the
/// source.
std::optional<Tile> CoordinateGrid::Compiler::curved_tile(const Stencil& nodes,
                                                          const Place& place) {
  const double fourth = curve_error(place);
  const FineTile<8> curve = remap::curved_tile(nodes);
  const auto in_cells = tile_of_cells(TileKind::Curved, curve, fourth);
  if (!in_cells) return std::nullopt;
  const auto fitted = fitted_tile(curve, fourth, place);
  return fitted ? fitted : in_cells;
}

/// `fourth`: the error of the curve itself.
std::optional<Tile> CoordinateGrid::Compiler::fitted_tile(const FineTile<8>& curve, double fourth,
                                                          const Place& place) {
  const FineTile<4> fine = remap::curved_tile(curve);
  const CoordinateTile pixels = fine.pixels();
  const Stencil nodes = fitted_nodes(pixels);
  if (is_too_steep(nodes, kTile)) return std::nullopt;
  double cells = 0;
  for (int j = 0; j < fine.kCells; ++j) {
    for (int i = 0; i < fine.kCells; ++i) {
      cells = std::max(cells, third_order_error(fine.stencil(i, j)));
    }
  }
  if (largest_error(Patch(nodes), pixels) + cells + fourth > close_at(level_of(nodes))) {
    return std::nullopt;
  }
  auto tile = patch_tile(nodes, place.tx, place.ty);
  if (!tile || tile->kind != TileKind::Patch) return std::nullopt;
  own_nodes(*tile, nodes);
  return tile;
}

/// Common part of tiles of finer patches. `fourth`: the error beyond the third order.
template <int Cell>
std::optional<Tile> CoordinateGrid::Compiler::tile_of_cells(TileKind kind,
                                                            const FineTile<Cell>& fine,
                                                            double fourth) const {
  Tile tile;
  tile.kind = kind;
  tile.level = level_of(fine);
  tile.interior = true;
  for (int j = 0; j < fine.kCells; ++j) {
    for (int i = 0; i < fine.kCells; ++i) {
      const Stencil cell = fine.stencil(i, j);
      if (is_too_steep(cell, Cell) || third_order_error(cell) + fourth > close_at(tile.level)) {
        return std::nullopt;
      }
      const Patch patch(cell);
      if (!is_inside(patch, tile.level)) return std::nullopt;
      tile.interior = tile.interior && is_interior(patch, tile.level);
    }
  }
  return tile;
}

/// A tile on nodes every 8 px; nullopt when it is not close or not inside the source.
std::optional<Tile> CoordinateGrid::Compiler::fine_tile(const Place& place) {
  constexpr int kCell = 8;
  FineTile<kCell> fine;
  const Lattice nodes{place.tx * kTile - kCell, place.ty * kTile - kCell, kCell, fine.kNodes,
                      fine.kNodes};
  ExactMap::MapLanes lanes;
  lanes.surfaces.fill(place.surface);
  const auto evaluate = [&](const optics::Vec2Lanes& pixels, std::size_t) {
    map_.on_surfaces(pixels, lanes);
  };
  bool defined = true;
  in_lanes(nodes, evaluate, [&](int i, int j, std::size_t k) {
    fine.nodes[j][i] = lanes.coordinates.at(k);
    const bool corner = i % (fine.kNodes - 1) == 0 && j % (fine.kNodes - 1) == 0;
    defined &= corner || is_defined(fine.nodes[j][i]);
  });
  if (!defined) return std::nullopt;
  const double fourth = fourth_order_error(fine);
  auto tile = tile_of_cells(TileKind::Fine, fine, fourth);
  if (!tile || !follows_the_map(fine.pixels(), place, tile->level)) {
    const FineTile<4> curved = remap::curved_tile(fine);
    tile = tile_of_cells(TileKind::CurvedFine, curved, fourth + mixed_error(fine));
    if (!tile || !follows_the_map(curved.pixels(), place, tile->level)) return std::nullopt;
  }
  tile->index = static_cast<std::uint32_t>(grid_.fine_.size());
  grid_.fine_.push_back(fine);
  return tile;
}

/// True if a sample of a tile's pixels agrees with the exact map. Differences of the nodes do not
/// bound the error of maps that need finer nodes.
bool CoordinateGrid::Compiler::follows_the_map(const CoordinateTile& pixels, const Place& place,
                                               int level) const {
  // Samples are next to a node along an axis and halfway between nodes, where errors of odd and of
  // even order are largest.
  constexpr int kFirst = 1, kStep = 4;
  const Lattice some{place.tx * kTile + kFirst, place.ty * kTile + kFirst, kStep, kTile / kStep,
                     kTile / kStep};
  ExactMap::MapLanes lanes;
  lanes.surfaces.fill(place.surface);
  const auto evaluate = [&](const optics::Vec2Lanes& asked, std::size_t) {
    map_.on_surfaces(asked, lanes);
  };
  bool all_close = true;
  in_lanes(some, evaluate, [&](int i, int j, std::size_t k) {
    const int x = kFirst + i * kStep, y = kFirst + j * kStep;
    if (x >= columns(place.tx) || y >= rows(place.ty)) return;
    const Coordinate truth = lanes.coordinates.at(k);
    all_close &= is_defined(truth) && distance(truth, pixels[y][x]) < close_at(level);
  });
  return all_close;
}

/// A tile's nodes, all evaluated on its surface; nullopt when one of them is not shown.
std::optional<Stencil> CoordinateGrid::Compiler::stencil(const Place& place) {
  Stencil nodes = grid_.stencil(place.tx, place.ty);
  const bool defined = all_nodes([&](int i, int j) {
    Coordinate& node = nodes.at(i, j);
    if (!place.uniform) node = extended_node(place.surface, place.tx + i, place.ty + j);
    return is_defined(node);
  });
  return defined ? std::optional(nodes) : std::nullopt;
}

Coordinate CoordinateGrid::Compiler::extended_node(int surface, int i, int j) {
  const std::size_t node = index(i, j);
  if (surfaces_[node] == surface) return grid_.nodes_[node];
  const auto row = static_cast<std::size_t>(surface - ExactMap::kNoSurface);
  if (row >= extended_.size()) extended_.resize(row + 1);
  std::vector<Coordinate>& extended = extended_[row];
  if (extended.empty()) extended.resize(surfaces_.size(), {kUnknown, 0});
  Coordinate& there = extended[node];
  if (there.u == kUnknown) there = map_.on_surface(surface, i * kTile, j * kTile);
  return there;
}

/// True if a patch on these nodes is within the tolerance of that level everywhere in the tile.
bool CoordinateGrid::Compiler::is_close(const Stencil& nodes, const Place& place, int level) const {
  if (is_too_steep(nodes, kTile)) return false;
  const double third = third_order_error(nodes), close = close_at(level);
  return third < close && third + fourth_order_part(nodes, place) < close;
}

/// The part of the error that third_order_error() does not include; not finite where unknown.
double CoordinateGrid::Compiler::fourth_order_part(const Stencil& nodes, const Place& place) const {
  const auto [tx, ty, surface, uniform] = place;
  // Uses five nodes in a row if the grid has them on one surface.
  if (uniform && tx > 0 && ty > 0 && surfaces_[index(tx - 2, ty)] == surface &&
      surfaces_[index(tx, ty - 2)] == surface) {
    std::array<Coordinate, 5> row, column;
    for (int k = 0; k < 5; ++k) {
      row[k] = grid_.node(tx - 2 + k, ty);
      column[k] = grid_.node(tx, ty - 2 + k);
    }
    return fourth_order_error(row) + fourth_order_error(column);
  }
  // This part is largest in the tile's middle, where the third-order error vanishes.
  constexpr int kMiddle = kTile / 2;
  const Coordinate truth = map_.on_surface(surface, tx * kTile + kMiddle, ty * kTile + kMiddle);
  return is_defined(truth) ? distance(truth, Patch(nodes).at(kMiddle, kMiddle)) : kUnknownError;
}

/// Bound of a curved tile's error: fourth order along rows and columns of nodes, the worst of those
/// around the tile, and x (1-x) y (1-y) / 4 of the mixed fourth difference between them. Not finite
/// where nodes are missing.
double CoordinateGrid::Compiler::curve_error(const Place& place) const {
  const int tx = place.tx, ty = place.ty, surface = place.surface;
  const auto in_grid = [&](int i, int j) {
    return i >= -1 && j >= -1 && i <= grid_.tiles_x_ + 1 && j <= grid_.tiles_y_ + 1;
  };
  // The error along five nodes from (i, j) on in that direction.
  const auto error = [&](int i, int j, int di, int dj) -> std::optional<double> {
    if (!in_grid(i, j) || !in_grid(i + 4 * di, j + 4 * dj)) return std::nullopt;
    std::array<Coordinate, 5> nodes;
    for (Coordinate& node : nodes) {
      node = grid_.node(i, j);
      if (!is_defined(node) || surfaces_[index(i, j)] != surface) return std::nullopt;
      i += di;
      j += dj;
    }
    return fourth_order_error(nodes);
  };
  double along_x = -1, along_y = -1;
  for (int side = 0; side < 2; ++side) {
    for (int before = 1; before <= 2; ++before) {
      along_x = std::max(along_x, error(tx - before, ty + side, 1, 0).value_or(-1));
      along_y = std::max(along_y, error(tx + side, ty - before, 0, 1).value_or(-1));
    }
  }
  if (along_x < 0 || along_y < 0) return kUnknownError;
  double mixed = 0;
  for (int j = ty; j <= ty + 1; ++j) {
    for (int i = tx; i <= tx + 1; ++i) {
      bool known = true;
      mixed = std::max(mixed, mixed_error([&](int a, int b) {
                         const Coordinate& node = grid_.node(i + a, j + b);
                         known &= is_defined(node) && surfaces_[index(i + a, j + b)] == surface;
                         return node;
                       }));
      if (!known) return kUnknownError;
    }
  }
  return along_x + along_y + mixed;
}

}  // namespace orbwatch::remap
