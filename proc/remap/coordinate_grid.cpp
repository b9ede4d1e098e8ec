#include "proc/remap/coordinate_grid.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace orbwatch::remap {
namespace {

constexpr double kOne = 1 << kFractionBits;

// Where a tile's patch is compared with the exact map: its error is largest on the edges and
// between them, never far from one of these.
constexpr std::array kProbes{0, 3, 8, 12, 15};

std::int32_t fixed(double pixels) { return static_cast<std::int32_t>(std::lround(pixels * kOne)); }

// Pixels are squares around their centres, so the picture reaches half a pixel further.
bool inside(std::int32_t coordinate, int size) {
  constexpr std::int32_t kHalf = 1 << (kFractionBits - 1);
  return coordinate >= -kHalf && coordinate <= (size - 1) * (1 << kFractionBits) + kHalf;
}

bool has_neighbours(std::int32_t lowest, std::int32_t highest, int size) {
  return lowest >= 0 && (highest >> kFractionBits) + 1 <= size - 1;
}

}  // namespace

/// The map that the grid approximates, with full precision.
struct CoordinateGrid::Exact {
  const optics::ViewProjection& view;
  const optics::BallProjection& ball;
  int source_width;
  int source_height;

  Coordinate at(int x, int y) const {
    const auto pixel = ball.pixel(view.direction(x, y));
    if (!pixel) return {kBlind, 0};
    // A ball far larger than the picture could exceed the fixed point's range.
    constexpr double kRange = (1 << (30 - kFractionBits));
    if (std::abs(pixel->u) > kRange || std::abs(pixel->v) > kRange) return {kOutside, 0};
    return {fixed(pixel->u), fixed(pixel->v)};
  }
  Coordinate marked(int x, int y) const {
    const Coordinate c = at(x, y);
    if (!is_defined(c)) return c;
    return inside(c.u, source_width) && inside(c.v, source_height) ? c : Coordinate{kOutside, 0};
  }
};

CoordinateGrid::CoordinateGrid(const optics::ViewProjection& view,
                               const optics::BallProjection& ball, int source_width,
                               int source_height)
    : width_(view.width()),
      height_(view.height()),
      source_width_(source_width),
      source_height_(source_height),
      tiles_x_((width_ + kTile - 1) / kTile),
      tiles_y_((height_ + kTile - 1) / kTile) {
  const Exact exact{view, ball, source_width, source_height};
  nodes_.reserve(static_cast<std::size_t>(tiles_x_ + 3) * (tiles_y_ + 3));
  for (int j = -1; j <= tiles_y_ + 1; ++j) {
    for (int i = -1; i <= tiles_x_ + 1; ++i) nodes_.push_back(exact.at(i * kTile, j * kTile));
  }
  tiles_.reserve(static_cast<std::size_t>(tiles_x_) * tiles_y_);
  for (int ty = 0; ty < tiles_y_; ++ty) {
    for (int tx = 0; tx < tiles_x_; ++tx) tiles_.push_back(classify(exact, tx, ty));
  }
  dense_.shrink_to_fit();
}

Tile CoordinateGrid::classify(const Exact& exact, int tx, int ty) {
  if (patch_is_possible(tx, ty) && patch_is_close(exact, tx, ty)) {
    const Tile tile = patch_tile(tx, ty);
    if (tile.kind == TileClass::Patch) return tile;
  }
  return dense_tile(exact, tx, ty);
}

bool CoordinateGrid::patch_is_possible(int tx, int ty) const {
  for (int j = -1; j <= 2; ++j) {
    for (int i = -1; i <= 2; ++i) {
      const bool corner_of_ring = (i == -1 || i == 2) && (j == -1 || j == 2);
      if (!corner_of_ring && !is_defined(node(tx + i, ty + j))) return false;
    }
  }
  return true;
}

PatchRow CoordinateGrid::patch_row(int tx, int ty, int y) const {
  const auto along = [&](std::int32_t Coordinate::*m, std::int64_t& value, std::int64_t& step,
                         std::int64_t& curve) {
    const auto n = [&](int i, int j) { return std::int64_t{node(tx + i, ty + j).*m}; };
    // Second differences, summed over the tile's four corners.
    const std::int64_t xx = n(-1, 0) - n(0, 0) - n(1, 0) + n(2, 0) +  //
                            n(-1, 1) - n(0, 1) - n(1, 1) + n(2, 1);
    const std::int64_t yy = n(0, -1) - n(0, 0) - n(0, 1) + n(0, 2) +  //
                            n(1, -1) - n(1, 0) - n(1, 1) + n(1, 2);
    const std::int64_t left = n(0, 0) * (kTile - y) + n(0, 1) * y;
    const std::int64_t right = n(1, 0) * (kTile - y) + n(1, 1) * y;
    // f(x) = [8 (left (16 - x) + right x) - x (16 - x) xx - y (16 - y) yy] / 2048
    value = 8 * kTile * left - y * (kTile - y) * yy;
    curve = 2 * xx;
    step = 8 * (right - left) - (kTile - 1) * xx;
  };
  PatchRow row{};
  along(&Coordinate::u, row.u, row.du, row.ddu);
  along(&Coordinate::v, row.v, row.dv, row.ddv);
  return row;
}

bool CoordinateGrid::patch_is_close(const Exact& exact, int tx, int ty) const {
  for (const int y : kProbes) {
    PatchRow row = patch_row(tx, ty, y);
    int x = 0;
    for (const int probe : kProbes) {
      for (; x < probe; ++x) row.step();
      const int view_x = tx * kTile + x, view_y = ty * kTile + y;
      if (view_x >= width_ || view_y >= height_) continue;
      const Coordinate truth = exact.at(view_x, view_y), patch = row.current();
      if (!is_defined(truth)) return false;
      // Between the probes the error can be a little larger than at them.
      constexpr double kLimit = 0.75 * kPatchTolerance * kOne;
      if (std::hypot(truth.u - patch.u, truth.v - patch.v) > kLimit) return false;
    }
  }
  return true;
}

Tile CoordinateGrid::patch_tile(int tx, int ty) const {
  std::int32_t u_low = INT32_MAX, u_high = INT32_MIN, v_low = INT32_MAX, v_high = INT32_MIN;
  const int rows = std::min(kTile, height_ - ty * kTile);
  const int columns = std::min(kTile, width_ - tx * kTile);
  for (int y = 0; y < rows; ++y) {
    PatchRow row = patch_row(tx, ty, y);
    for (int x = 0; x < columns; ++x, row.step()) {
      const Coordinate c = row.current();
      u_low = std::min(u_low, c.u);
      u_high = std::max(u_high, c.u);
      v_low = std::min(v_low, c.v);
      v_high = std::max(v_high, c.v);
    }
  }
  Tile tile;
  const bool in_picture = inside(u_low, source_width_) && inside(u_high, source_width_) &&
                          inside(v_low, source_height_) && inside(v_high, source_height_);
  tile.kind = in_picture ? TileClass::Patch : TileClass::Dense;
  tile.interior =
      has_neighbours(u_low, u_high, source_width_) && has_neighbours(v_low, v_high, source_height_);
  return tile;
}

Tile CoordinateGrid::dense_tile(const Exact& exact, int tx, int ty) {
  Tile tile;
  tile.kind = TileClass::Dense;
  tile.dense = static_cast<std::uint32_t>(dense_.size());
  const int columns = std::min(kTile, width_ - tx * kTile);
  const int rows = std::min(kTile, height_ - ty * kTile);
  bool all_blind = true, all_outside = true;
  for (int y = 0; y < kTile; ++y) {
    for (int x = 0; x < kTile; ++x) {
      const bool in_view = x < columns && y < rows;
      const Coordinate c =
          in_view ? exact.marked(tx * kTile + x, ty * kTile + y) : Coordinate{kBlind, 0};
      all_blind &= !in_view || c.u == kBlind;
      all_outside &= !in_view || c.u == kOutside;
      dense_.push_back(c);
    }
  }
  if (all_blind || all_outside) {
    dense_.resize(tile.dense);
    return {all_blind ? TileClass::Blind : TileClass::Outside, false, 0};
  }
  return tile;
}

void CoordinateGrid::write_validity(const ImageView<std::uint8_t>& out) const {
  for (int y = 0; y < height_; ++y) {
    for (int x = 0; x < width_; ++x) {
      const Tile& t = tile(x / kTile, y / kTile);
      Validity validity = Validity::Seen;
      if (t.kind == TileClass::Blind) validity = Validity::Blind;
      if (t.kind == TileClass::Outside) validity = Validity::Outside;
      if (t.kind == TileClass::Dense) {
        const Coordinate& c = dense_row(t, y % kTile)[x % kTile];
        if (!is_defined(c)) validity = c.u == kBlind ? Validity::Blind : Validity::Outside;
      }
      *out.at(x, y) = static_cast<std::uint8_t>(validity);
    }
  }
}

std::size_t CoordinateGrid::bytes() const {
  return nodes_.size() * sizeof(Coordinate) + tiles_.size() * sizeof(Tile) +
         dense_.size() * sizeof(Coordinate);
}

}  // namespace orbwatch::remap
