#include "proc/remap/grid_compiler.h"

#include <algorithm>
#include <cmath>

namespace orbwatch::remap {
namespace {

// Q13 pixels. What a patch's error may be by its nodes: the rest of the tolerance is for terms of
// higher order than the fourth.
constexpr double kTolerated = kTolerance * (1 << kFractionBits);
constexpr double kClose = 0.85 * kTolerated;

// A node on a surface that was not asked for yet.
constexpr std::int32_t kUnknown = kOutside + 1;

double distance(const Coordinate& a, const Coordinate& b) {
  const double u = double{1} * a.u - b.u, v = double{1} * a.v - b.v;
  return std::sqrt(u * u + v * v);
}

/// The error of fourth order at most, from five nodes in a row: Lagrange's
/// t (1-t) (1+t) (2-t) / 24 of the fourth difference.
double fourth_order_error(const std::array<Coordinate, 5>& row) {
  constexpr double kLargest = 0.0235;
  constexpr std::array kBinomial{1.0, -4.0, 6.0, -4.0, 1.0};
  double u = 0, v = 0;
  for (std::size_t k = 0; k < row.size(); ++k) {
    u += kBinomial[k] * row[k].u;
    v += kBinomial[k] * row[k].v;
  }
  return kLargest * std::sqrt(u * u + v * v);
}

/// The largest one along each axis of a tile, added up.
template <int Cell>
double fourth_order_error(const FineTile<Cell>& fine) {
  double along_u = 0, along_v = 0;
  // The outer rows end at corners that do not count.
  for (int line = 1; line + 1 < fine.kNodes; ++line) {
    for (int first = 0; first + 5 <= fine.kNodes; ++first) {
      std::array<Coordinate, 5> row, column;
      for (int k = 0; k < 5; ++k) {
        row[k] = fine.nodes[line][first + k];
        column[k] = fine.nodes[first + k][line];
      }
      along_u = std::max(along_u, fourth_order_error(row));
      along_v = std::max(along_v, fourth_order_error(column));
    }
  }
  return along_u + along_v;
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
  /// The neighbours for interpolation are there too.
  bool holds_neighbours(std::int32_t lowest, std::int32_t highest) const {
    return lowest >= 0 && highest < high - kHalf;
  }
};

}  // namespace

CoordinateGrid::Compiler::Compiler(CoordinateGrid& grid, const optics::ViewProjection& view,
                                   const optics::BallProjection& ball)
    : grid_(grid),
      map_(view, ball),
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
  grid_.tiles_.reserve(static_cast<std::size_t>(grid_.tiles_x_) * grid_.tiles_y_);
  for (int ty = 0; ty < grid_.tiles_y_; ++ty) {
    for (int tx = 0; tx < grid_.tiles_x_; ++tx) grid_.tiles_.push_back(compile(tx, ty));
  }
  const auto fit = [](auto&... stores) { (stores.shrink_to_fit(), ...); };
  fit(grid_.own_nodes_, grid_.split_, grid_.fine8_, grid_.fine4_, grid_.packed_, grid_.whole_);
}

void CoordinateGrid::Compiler::evaluate_nodes() {
  const std::size_t count = index(-1, grid_.tiles_y_ + 2);
  grid_.nodes_.reserve(count);
  surfaces_.reserve(count);
  for (int j = -1; j <= grid_.tiles_y_ + 1; ++j) {
    for (int i = -1; i <= grid_.tiles_x_ + 1; ++i) {
      const ExactMap::Sight sight = map_.see(i * kTile, j * kTile);
      surfaces_.push_back(sight.surface);
      grid_.nodes_.push_back(sight.coordinate);
    }
  }
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
    auto tile = patch_tile(Patch(*nodes), place.tx, place.ty);
    if (tile && tile->kind == TileClass::Patch && !place.uniform) {
      tile->store = TileStore::OwnNodes;
      tile->index = static_cast<std::uint32_t>(grid_.own_nodes_.size());
      grid_.own_nodes_.push_back(*nodes);
    }
    if (tile) return *tile;
  } else {
    // Errors of third order: an eighth for half the distance.
    const bool worth = nodes && third_order_error(*nodes) / 8 < kClose;
    if (auto tile = worth ? fine_tile<8>(place, grid_.fine8_) : std::nullopt) return *tile;
    if (auto tile = fine_tile<4>(place, grid_.fine4_)) return *tile;
  }
  Surfaces surfaces;
  for (auto& row : surfaces) row.fill(place.surface);
  return pixel_tile(place.tx, place.ty, surfaces);
}

/// A Patch tile, or an Outside one; nothing when the source picture's border runs through it.
std::optional<Tile> CoordinateGrid::Compiler::patch_tile(const Patch& patch, int tx, int ty) const {
  const Extent u(grid_.source_width_), v(grid_.source_height_);
  const auto [low, high] = patch.range();
  Tile tile;
  if (u.surely_misses(low.u, high.u) || v.surely_misses(low.v, high.v)) {
    tile.kind = TileClass::Outside;
    return tile;
  }
  tile.kind = TileClass::Patch;
  tile.interior = u.holds_neighbours(low.u, high.u) && v.holds_neighbours(low.v, high.v);
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

bool CoordinateGrid::Compiler::is_inside(const Patch& patch) const {
  const auto [low, high] = patch.range();
  return Extent(grid_.source_width_).surely_holds(low.u, high.u) &&
         Extent(grid_.source_height_).surely_holds(low.v, high.v);
}

/// A tile in finer patches; nothing when one of them is not close or not inside the source.
template <int Cell>
std::optional<Tile> CoordinateGrid::Compiler::fine_tile(const Place& place,
                                                        std::vector<FineTile<Cell>>& store) const {
  FineTile<Cell> fine;
  for (int j = 0; j < fine.kNodes; ++j) {
    for (int i = 0; i < fine.kNodes; ++i) {
      fine.nodes[j][i] = map_.on_surface(place.surface, place.tx * kTile + (i - 1) * Cell,
                                         place.ty * kTile + (j - 1) * Cell);
      const bool corner = i % (fine.kNodes - 1) == 0 && j % (fine.kNodes - 1) == 0;
      if (!corner && !is_defined(fine.nodes[j][i])) return std::nullopt;
    }
  }
  const double fourth = fourth_order_error(fine);
  for (int j = 0; j < fine.kCells; ++j) {
    for (int i = 0; i < fine.kCells; ++i) {
      const Stencil cell = fine.stencil(i, j);
      if (third_order_error(cell) + fourth > kClose || !is_inside(Patch(cell))) return std::nullopt;
    }
  }
  Tile tile;
  tile.kind = TileClass::Dense;
  tile.store = Cell == 8 ? TileStore::Fine8 : TileStore::Fine4;
  tile.index = static_cast<std::uint32_t>(store.size());
  store.push_back(fine);
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
  for (int y = 0; y < rows(ty); ++y) {
    for (int x = 0; x < columns(tx); ++x) {
      Coordinate& c = whole.coordinates[y][x];
      c = map_.on_surface(surfaces[y][x], tx * kTile + x, ty * kTile + y);
      if (is_defined(c) && !(u.holds(c.u) && v.holds(c.v))) c = {kOutside, 0};
      all_blind &= c.u == kBlind;
      all_outside &= c.u == kOutside;
    }
  }
  Tile tile;
  tile.kind = all_blind ? TileClass::Blind : TileClass::Outside;
  if (all_blind || all_outside) return tile;
  tile.kind = TileClass::Dense;
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

}  // namespace orbwatch::remap
