#include "proc/remap/grid_compiler.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "proc/remap/tile_level.h"
#include "proc/remap/tolerance.h"

namespace orbwatch::remap {
namespace {

// A node on a surface that was not asked for yet.
constexpr std::int32_t kUnknown = kOutside + 1;

/// The error of fourth order at most: the largest along each axis, added up.
double fourth_order_error(const FineTile<8>& fine) {
  double along_u = 0, along_v = 0;
  // The outer rows end at corners that do not count.
  for (int line = 1; line + 1 < fine.kNodes; ++line) {
    std::array<Coordinate, 5> column;
    for (int k = 0; k < fine.kNodes; ++k) column[k] = fine.nodes[k][line];
    along_u = std::max(along_u, fourth_order_error(fine.nodes[line]));
    along_v = std::max(along_v, fourth_order_error(column));
  }
  return along_u + along_v;
}

/// What a Coons patch leaves out between its four curves: at most 1/64 of the mixed fourth
/// difference about a node, `at(i, j)` being those around it.
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

/// In the middle of each side and of the tile, away from corners that do not count.
double mixed_error(const FineTile<8>& fine) {
  double error = 0;
  for (const auto& [x, y] : {std::pair{2, 2}, {1, 2}, {3, 2}, {2, 1}, {2, 3}}) {
    const auto at = [&, i0 = x, j0 = y](int i, int j) { return fine.nodes[j0 + j][i0 + i]; };
    error = std::max(error, mixed_error(at));
  }
  return error;
}

/// Where a coordinate along one axis stands to the source picture. Pixels are squares around their
/// centres, so the picture reaches half a pixel further.
struct Extent {
  static constexpr std::int32_t kHalf = 1 << (kFractionBits - 1);
  static constexpr auto kMargin = static_cast<std::int32_t>(kTolerated);
  std::int32_t low = -kHalf;
  std::int32_t high;

  explicit Extent(int size) : high(((size - 1) << kFractionBits) + kHalf) {}

  bool holds(std::int32_t c) const { return c >= low && c <= high; }
  /// Also if all of it were off by the tolerance.
  bool surely_holds(std::int32_t lowest, std::int32_t highest) const {
    return lowest > low + kMargin && highest < high - kMargin;
  }
  bool surely_misses(std::int32_t lowest, std::int32_t highest) const {
    return highest < low - kMargin || lowest > high + kMargin;
  }
};

}  // namespace

CoordinateGrid::Compiler::Compiler(CoordinateGrid& grid, const optics::ViewProjection& view,
                                   const optics::BallProjection& ball)
    : grid_(grid),
      map_(view, ball),
      plain_(grid.tiles_x_, grid.tiles_y_, grid.source_width_, grid.source_height_),
      edges_(edge_mask(view, ball.proxy().edges())),
      // A ball's picture jumps where the camera's rays pass an edge, which is not where the ball's
      // centre sees that edge.
      is_smooth_(view.kind() != optics::ViewKind::Ball || ball.proxy().is_far()) {
  edges_are_known_ = is_smooth_ && ball.proxy().lists_every_edge();
  // Every projection steps furthest in its middle.
  const double u = (view.width() - 1) / 2.0, v = (view.height() - 1) / 2.0;
  const auto middle = view.direction(u, v);
  const auto aside = view.direction(u + kTile, v), below = view.direction(u, v + kTile);
  constexpr double kSomeDegrees = 0.2;
  nodes_are_close_ = middle && aside && below && norm(*aside - *middle) < kSomeDegrees &&
                     norm(*below - *middle) < kSomeDegrees;
}

void CoordinateGrid::Compiler::run() {
  evaluate_nodes();
  constexpr int kRun = PlainTiles::kRun;
  for (int ty = 0; ty < grid_.tiles_y_; ++ty) {
    for (int tx = 0; tx < grid_.tiles_x_; tx += kRun) {
      PlainTiles::Levels levels;
      plain_.judge(tx, ty, levels);
      compile_run(tx, ty, levels);
    }
  }
  const auto fit = [](auto&... stores) { (stores.shrink_to_fit(), ...); };
  fit(grid_.own_nodes_, grid_.split_, grid_.fine_, grid_.packed_, grid_.whole_);
}

/// As many tiles from (tx, ty) on as were judged.
void CoordinateGrid::Compiler::compile_run(int tx, int ty, const PlainTiles::Levels& levels) {
  const int count = std::min(static_cast<int>(levels.size()), grid_.tiles_x_ - tx);
  for (int k = 0; k < count; ++k) {
    const std::int32_t level = levels[static_cast<std::size_t>(k)];
    const bool plain =
        level != PlainTiles::kLookCloser && is_smooth_ && !edges_.crosses(tx + k, ty);
    const Tile tile =
        plain ? Tile{TileClass::Patch, TileStore::Grid, true, static_cast<std::uint8_t>(level), 0}
              : compile(tx + k, ty);
    grid_.tiles_.set(tile_number(tx + k, ty), tile);
    grid_.levels_ = std::max<int>(grid_.levels_, tile.level);
  }
}

void CoordinateGrid::Compiler::evaluate_nodes() {
  const Lattice nodes{-kTile, -kTile, kTile, grid_.tiles_x_ + 3, grid_.tiles_y_ + 3};
  const std::size_t count = index(-1, grid_.tiles_y_ + 2);
  grid_.nodes_.resize(count);
  surfaces_.resize(count);
  ExactMap::SightLanes sights;
  std::size_t number = 0;
  const auto see = [&](const optics::Vec2Lanes& pixels, std::size_t) { map_.see(pixels, sights); };
  in_lanes(nodes, see, [&](int i, int j, std::size_t k) {
    const Coordinate node = sights.coordinates.at(k);
    surfaces_[number] = sights.surfaces[k];
    grid_.nodes_[number++] = node;
    plain_.set_node(i - 1, j - 1, node, sights.surfaces[k]);
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
    // Where no edge runs the next pixel is on the same surface.
    const unsigned asked = 1U | (known ? edges_.row(tx, ty * kTile + y) : ~0U);
    int surface = ExactMap::kNoSurface;
    for (int x = 0; x < columns(tx); ++x) {
      if (asked >> x & 1U) surface = map_.surface(tx * kTile + x, ty * kTile + y);
      surfaces[y][x] = surface;
    }
  }
  return surfaces;
}

Tile CoordinateGrid::Compiler::tile_on_surface(const Place& place) {
  const auto nodes = stencil(place);
  if (nodes && is_close(*nodes, place)) {
    auto tile = patch_tile(*nodes, place.tx, place.ty);
    if (tile && tile->kind == TileClass::Patch && !place.uniform) {
      tile->store = TileStore::OwnNodes;
      tile->index = static_cast<std::uint32_t>(grid_.own_nodes_.size());
      grid_.own_nodes_.push_back(*nodes);
    }
    if (tile) return *tile;
  } else {
    const bool on_grid = nodes && place.uniform;
    if (auto tile = on_grid ? curved_tile(*nodes, curve_error(place)) : std::nullopt) return *tile;
    if (auto tile = fine_tile(place)) return *tile;
  }
  Surfaces surfaces;
  for (auto& row : surfaces) row.fill(place.surface);
  return pixel_tile(place.tx, place.ty, surfaces);
}

/// A Patch tile, or an Outside one; nothing when the source picture's border runs through it.
std::optional<Tile> CoordinateGrid::Compiler::patch_tile(const Stencil& nodes, int tx,
                                                         int ty) const {
  const Patch patch(nodes);
  const Extent u(grid_.source_width_), v(grid_.source_height_);
  const auto [low, high] = patch.range();
  Tile tile;
  if (u.surely_misses(low.u, high.u) || v.surely_misses(low.v, high.v)) {
    tile.kind = TileClass::Outside;
    return tile;
  }
  tile.kind = TileClass::Patch;
  tile.level = level_of(nodes);
  tile.interior = is_interior(patch, tile.level);
  if (tile.interior || is_inside(patch)) return tile;
  // The part that lies in the view may be inside although the patch is not.
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

bool CoordinateGrid::Compiler::is_inside(const Patch& patch) const {
  const auto [low, high] = patch.range();
  return Extent(grid_.source_width_).surely_holds(low.u, high.u) &&
         Extent(grid_.source_height_).surely_holds(low.v, high.v);
}

/// A tile of third order on the grid's nodes; nothing when it is not close or not inside the
/// source.
std::optional<Tile> CoordinateGrid::Compiler::curved_tile(const Stencil& nodes,
                                                          double fourth) const {
  auto tile = tile_of_cells(remap::curved_tile(nodes), fourth);
  if (tile) tile->store = TileStore::Curved;
  return tile;
}

/// What finer patches have in common. `fourth`: the error beyond that of third order.
template <int Cell>
std::optional<Tile> CoordinateGrid::Compiler::tile_of_cells(const FineTile<Cell>& fine,
                                                            double fourth) const {
  Tile tile;
  tile.kind = TileClass::Dense;
  tile.level = level_of(fine);
  tile.interior = true;
  for (int j = 0; j < fine.kCells; ++j) {
    for (int i = 0; i < fine.kCells; ++i) {
      const Stencil cell = fine.stencil(i, j);
      if (third_order_error(cell) + fourth > kClose) return std::nullopt;
      const Patch patch(cell);
      if (!is_inside(patch)) return std::nullopt;
      tile.interior = tile.interior && is_interior(patch, tile.level);
    }
  }
  return tile;
}

/// A tile on nodes every 8 px; nothing when it is not close or not inside the source.
std::optional<Tile> CoordinateGrid::Compiler::fine_tile(const Place& place) {
  constexpr int kCell = 8;
  FineTile<kCell> fine;
  const Lattice nodes{place.tx * kTile - kCell, place.ty * kTile - kCell, kCell, fine.kNodes,
                      fine.kNodes};
  ExactMap::SightLanes sights;
  sights.surfaces.fill(place.surface);
  const auto see = [&](const optics::Vec2Lanes& pixels, std::size_t) {
    map_.on_surfaces(pixels, sights);
  };
  bool defined = true;
  in_lanes(nodes, see, [&](int i, int j, std::size_t k) {
    fine.nodes[j][i] = sights.coordinates.at(k);
    const bool corner = i % (fine.kNodes - 1) == 0 && j % (fine.kNodes - 1) == 0;
    defined &= corner || is_defined(fine.nodes[j][i]);
  });
  if (!defined) return std::nullopt;
  const double fourth = fourth_order_error(fine);
  auto tile = tile_of_cells(fine, fourth);
  if (tile) {
    tile->store = TileStore::Fine;
  } else {
    tile = tile_of_cells(remap::curved_tile(fine), fourth + mixed_error(fine));
    if (!tile) return std::nullopt;
    tile->store = TileStore::CurvedFine;
  }
  tile->index = static_cast<std::uint32_t>(grid_.fine_.size());
  grid_.fine_.push_back(fine);
  return tile;
}

Tile CoordinateGrid::Compiler::tile_of_surfaces(int tx, int ty, const Surfaces& surfaces) {
  if (auto tile = split_tile(tx, ty, surfaces)) return *tile;
  return pixel_tile(tx, ty, surfaces);
}

/// A tile on two surfaces; nothing when there are more, or a patch of them is not close or not
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
    if (!nodes || !is_close(*nodes, place) || !is_inside(Patch(*nodes))) return std::nullopt;
    split.sides[side] = *nodes;
  }
  Tile tile;
  tile.kind = TileClass::Dense;
  tile.store = TileStore::Split;
  tile.level = std::max(level_of(split.sides[0]), level_of(split.sides[1]));
  tile.index = static_cast<std::uint32_t>(grid_.split_.size());
  grid_.split_.push_back(split);
  return tile;
}

/// A tile whose pixels are evaluated one by one.
Tile CoordinateGrid::Compiler::pixel_tile(int tx, int ty, const Surfaces& surfaces) {
  const Extent u(grid_.source_width_), v(grid_.source_height_);
  WholeTile whole;
  for (CoordinateRow& row : whole.coordinates) row.fill({kBlind, 0});
  bool all_blind = true, all_outside = true;
  ExactMap::SightLanes sights;
  const auto see = [&](const optics::Vec2Lanes& pixels, std::size_t first) {
    std::copy_n(&surfaces[first / kTile][first % kTile], sights.surfaces.size(),
                sights.surfaces.begin());
    map_.on_surfaces(pixels, sights);
  };
  in_lanes({tx * kTile, ty * kTile, 1, kTile, kTile}, see, [&](int x, int y, std::size_t k) {
    if (x >= columns(tx) || y >= rows(ty)) return;
    Coordinate& c = whole.coordinates[y][x];
    c = sights.coordinates.at(k);
    if (is_defined(c) && !(u.holds(c.u) && v.holds(c.v))) c = {kOutside, 0};
    all_blind &= c.u == kBlind;
    all_outside &= c.u == kOutside;
  });
  Tile tile;
  tile.kind = all_blind ? TileClass::Blind : TileClass::Outside;
  if (all_blind || all_outside) return tile;
  tile.kind = TileClass::Dense;
  tile.level = level_of(whole.coordinates);
  const auto packed = PackedTile::pack(whole.coordinates);
  tile.store = packed ? TileStore::Packed : TileStore::Whole;
  tile.index = static_cast<std::uint32_t>(packed ? grid_.packed_.size() : grid_.whole_.size());
  if (packed) {
    grid_.packed_.push_back(*packed);
  } else {
    grid_.whole_.push_back(whole);
  }
  return tile;
}

/// A tile's nodes as if all of them were on its surface; nothing when one of them is not shown.
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

/// Whether a patch on these nodes is within the tolerance everywhere in the tile.
bool CoordinateGrid::Compiler::is_close(const Stencil& nodes, const Place& place) const {
  const double third = third_order_error(nodes);
  return third < kClose && third + fourth_order_part(nodes, place) < kClose;
}

/// What third_order_error() leaves out.
double CoordinateGrid::Compiler::fourth_order_part(const Stencil& nodes, const Place& place) const {
  const auto [tx, ty, surface, uniform] = place;
  // Five nodes in a row, where the grid has them on one surface.
  if (uniform && tx > 0 && ty > 0 && surfaces_[index(tx - 2, ty)] == surface &&
      surfaces_[index(tx, ty - 2)] == surface) {
    std::array<Coordinate, 5> row, column;
    for (int k = 0; k < 5; ++k) {
      row[k] = grid_.node(tx - 2 + k, ty);
      column[k] = grid_.node(tx, ty - 2 + k);
    }
    return fourth_order_error(row) + fourth_order_error(column);
  }
  // In the tile's middle it is largest, and the error of third order vanishes.
  constexpr int kMiddle = kTile / 2;
  const Coordinate truth = map_.on_surface(surface, tx * kTile + kMiddle, ty * kTile + kMiddle);
  return is_defined(truth) ? distance(truth, Patch(nodes).at(kMiddle, kMiddle)) : kTolerated;
}

/// What a curved tile's error may be: of fourth order along rows and columns of nodes, the worst of
/// those around the tile, and x (1-x) y (1-y) / 4 of the mixed fourth difference between them. Not
/// finite where the nodes do not tell.
double CoordinateGrid::Compiler::curve_error(const Place& place) const {
  const auto [tx, ty, surface, uniform] = place;
  const auto in_grid = [&](int i, int j) {
    return i >= -1 && j >= -1 && i <= grid_.tiles_x_ + 1 && j <= grid_.tiles_y_ + 1;
  };
  // From a node five in that direction.
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
  constexpr double kUnknownError = std::numeric_limits<double>::infinity();
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
