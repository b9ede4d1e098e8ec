// SPDX-License-Identifier: Apache-2.0
#include "proc/remap/compiler/grid_compiler.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "proc/remap/compiler/mip_level.h"
#include "proc/remap/compiler/tolerance.h"

namespace orbwatch::remap {
namespace {

/// The largest angle that a tile spans, radians.
double tile_angle(const optics::ViewProjection& view) {
  // Every projection has its largest step in the middle. The step is measured over so small a part
  // that no panorama wraps around.
  constexpr double kPart = 1.0 / 1024;
  const double u = (view.width() - 1) / 2.0, v = (view.height() - 1) / 2.0;
  const auto middle = view.direction(u, v);
  const auto aside = view.direction(u + kPart * kTile, v);
  const auto below = view.direction(u, v + kPart * kTile);
  if (!middle || !aside || !below) return std::numeric_limits<double>::infinity();
  return std::max(norm(*aside - *middle), norm(*below - *middle)) / kPart;
}

}  // namespace

CoordinateGrid::Compiler::Compiler(CoordinateGrid& grid, const optics::ViewProjection& view,
                                   const optics::BallProjection& ball)
    : grid_(grid),
      map_(view, ball),
      plain_(grid.tiles_x_, grid.tiles_y_, grid.source_width_, grid.source_height_),
      edges_(edge_mask(view, ball.proxy().edges())),
      // A ball's picture jumps where the camera's rays pass an edge, not where the edge lies as
      // seen from the ball's centre.
      is_smooth_(view.kind() != optics::ViewKind::Ball || ball.proxy().is_far()) {
  constexpr double kSomeDegrees = 0.2, kHalfTurn = 3.14;
  const double angle = tile_angle(view);
  nodes_are_close_ = angle < kSomeDegrees;
  // The nodes of a view that wraps around within a tile would all be alike.
  is_smooth_ = is_smooth_ && angle < kHalfTurn;
  edges_are_known_ = is_smooth_ && ball.proxy().lists_every_edge();
}

void CoordinateGrid::Compiler::run() {
  evaluate_nodes();
  constexpr int kRun = PlainTiles::kRun;
  for (int ty = 0; ty < grid_.tiles_y_; ++ty) {
    for (int tx = 0; tx < grid_.tiles_x_; tx += kRun) {
      PlainTiles::Levels levels;
      plain_.classify(tx, ty, levels);
      compile_run(tx, ty, levels);
    }
  }
  const auto fit = [](auto&... stores) { (stores.shrink_to_fit(), ...); };
  fit(grid_.own_nodes_, grid_.split_, grid_.fine_, grid_.pixel_tiles_);
}

/// Compiles a run of tiles from (tx, ty) on.
void CoordinateGrid::Compiler::compile_run(int tx, int ty, const PlainTiles::Levels& levels) {
  const int count = std::min(static_cast<int>(levels.size()), grid_.tiles_x_ - tx);
  for (int k = 0; k < count; ++k) {
    const std::int32_t level = levels[static_cast<std::size_t>(k)];
    const bool plain = level != PlainTiles::kNotPlain && is_smooth_ && !edges_.crosses(tx + k, ty);
    const Tile tile =
        plain ? Tile{TileKind::Patch, true, static_cast<std::uint8_t>(level)} : compile(tx + k, ty);
    grid_.tiles_.set(tile_number(tx + k, ty), tile);
    grid_.levels_ = std::max<int>(grid_.levels_, tile.level);
  }
}

void CoordinateGrid::Compiler::evaluate_nodes() {
  const Lattice nodes{-kTile, -kTile, kTile, grid_.tiles_x_ + 3, grid_.tiles_y_ + 3};
  const std::size_t count = index(-1, grid_.tiles_y_ + 2);
  grid_.nodes_.resize(count);
  surfaces_.resize(count);
  ExactMap::MapLanes lanes;
  std::size_t number = 0;
  const auto evaluate = [&](const optics::Vec2Lanes& pixels, std::size_t) {
    map_.evaluate(pixels, lanes);
  };
  in_lanes(nodes, evaluate, [&](int i, int j, std::size_t k) {
    const Coordinate node = lanes.coordinates.at(k);
    surfaces_[number] = lanes.surfaces[k];
    grid_.nodes_[number++] = node;
    plain_.set_node(i - 1, j - 1, node, lanes.surfaces[k]);
  });
  plain_.finish();
}

Tile CoordinateGrid::Compiler::compile(int tx, int ty) {
  if (!is_smooth_) return pixel_tile(tx, ty, surfaces_of(tx, ty));
  const Place place{tx, ty, surfaces_[index(tx, ty)], is_uniform(tx, ty)};
  if (place.surface == ExactMap::kNoSurface || !(place.uniform || is_in_projection(tx, ty))) {
    return pixel_tile(tx, ty, surfaces_of(tx, ty));
  }
  if (!edges_.crosses(tx, ty)) {
    if (place.uniform) return is_blind(tx, ty) ? Tile{} : tile_on_surface(place);
    if (edges_are_known_) return tile_on_surface(place);
  }
  const Surfaces surfaces = surfaces_of(tx, ty);
  for (int y = 0; y < rows(ty); ++y) {
    for (int x = 0; x < columns(tx); ++x) {
      if (surfaces[y][x] != place.surface) return tile_of_surfaces(tx, ty, surfaces);
    }
  }
  return tile_on_surface(place);
}

bool CoordinateGrid::Compiler::is_uniform(int tx, int ty) const {
  const int surface = surfaces_[index(tx, ty)];
  return all_nodes([&](int i, int j) { return surfaces_[index(tx + i, ty + j)] == surface; });
}

bool CoordinateGrid::Compiler::is_in_projection(int tx, int ty) const {
  return all_nodes(
      [&](int i, int j) { return surfaces_[index(tx + i, ty + j)] != ExactMap::kNoSurface; });
}

bool CoordinateGrid::Compiler::is_blind(int tx, int ty) const {
  return nodes_are_close_ &&
         all_nodes([&](int i, int j) { return grid_.node(tx + i, ty + j).u == kBlind; });
}

/// The surface of each pixel of a tile.
CoordinateGrid::Compiler::Surfaces CoordinateGrid::Compiler::surfaces_of(int tx, int ty) const {
  const bool known = edges_are_known_ && is_in_projection(tx, ty);
  Surfaces surfaces{};
  for (int y = 0; y < rows(ty); ++y) {
    // The next pixel is on the same surface where no edge runs.
    const unsigned asked = 1U | (known ? edges_.row(tx, ty * kTile + y) : ~0U);
    int surface = ExactMap::kNoSurface;
    for (int x = 0; x < columns(tx); ++x) {
      if (asked >> x & 1U) surface = map_.surface(tx * kTile + x, ty * kTile + y);
      surfaces[y][x] = surface;
    }
  }
  return surfaces;
}

Tile CoordinateGrid::Compiler::tile_of_surfaces(int tx, int ty, const Surfaces& surfaces) {
  if (auto tile = split_tile(tx, ty, surfaces)) return *tile;
  return pixel_tile(tx, ty, surfaces);
}

/// A tile on two surfaces; nullopt when there are more, or a patch of them is not close or not
/// inside the source.
std::optional<Tile> CoordinateGrid::Compiler::split_tile(int tx, int ty, const Surfaces& surfaces) {
  const int first = surfaces[0][0];
  int second = first;
  SplitTile split{};
  for (int y = 0; y < rows(ty); ++y) {
    for (int x = 0; x < columns(tx); ++x) {
      const int surface = surfaces[y][x];
      if (surface == first) continue;
      if (second == first) second = surface;
      if (surface != second) return std::nullopt;
      split.second[y] |= static_cast<std::uint16_t>(1U << x);
    }
  }
  for (int side = 0; side < 2; ++side) {
    const Place place{tx, ty, side == 0 ? first : second, false};
    const auto nodes = stencil(place);
    if (!nodes) return std::nullopt;
    const int level = level_of(*nodes);
    if (!is_close(*nodes, place, level) || !is_inside(Patch(*nodes), level)) return std::nullopt;
    split.sides[side] = *nodes;
  }
  Tile tile;
  tile.kind = TileKind::Split;
  tile.level = std::max(level_of(split.sides[0]), level_of(split.sides[1]));
  tile.index = static_cast<std::uint32_t>(grid_.split_.size());
  grid_.split_.push_back(split);
  return tile;
}

/// A tile whose pixels are evaluated one by one.
Tile CoordinateGrid::Compiler::pixel_tile(int tx, int ty, const Surfaces& surfaces) {
  const SourceExtent u(grid_.source_width_), v(grid_.source_height_);
  CoordinateTile pixels;
  for (CoordinateRow& row : pixels) row.fill({kBlind, 0});
  bool all_blind = true, all_outside = true;
  ExactMap::MapLanes lanes;
  const auto evaluate = [&](const optics::Vec2Lanes& asked, std::size_t first) {
    for (std::size_t k = 0; k < optics::kLanes; ++k) {
      lanes.surfaces[k] = surfaces[(first + k) / kTile][(first + k) % kTile];
    }
    map_.on_surfaces(asked, lanes);
  };
  in_lanes({tx * kTile, ty * kTile, 1, kTile, kTile}, evaluate, [&](int x, int y, std::size_t k) {
    if (x >= columns(tx) || y >= rows(ty)) return;
    Coordinate& c = pixels[y][x];
    c = lanes.coordinates.at(k);
    if (is_defined(c) && !(u.holds(c.u) && v.holds(c.v))) c = {kOutside, 0};
    all_blind &= c.u == kBlind;
    all_outside &= c.u == kOutside;
  });
  Tile tile;
  tile.kind = all_blind ? TileKind::Blind : TileKind::Outside;
  if (all_blind || all_outside) return tile;
  tile.kind = TileKind::Pixels;
  tile.level = level_of(pixels);
  tile.index = grid_.pixel_tiles_.add(pixels);
  return tile;
}

}  // namespace orbwatch::remap
