// SPDX-License-Identifier: Apache-2.0
#include "proc/remap/grid/tile_stores.h"

#include <algorithm>
#include <bit>

#include "proc/remap/kernel/kernel_map.h"
#include "proc/remap/sampling/plane_map.h"

namespace orbwatch::remap {
namespace {

constexpr std::uint16_t kBlindOffset = UINT16_MAX;
constexpr std::uint16_t kOutsideOffset = UINT16_MAX - 1;
constexpr std::int64_t kLargestOffset = UINT16_MAX - 2;
// Rounding to steps of 1/256 px loses 1/360 px at most, for which the grid's tolerance has room.
constexpr int kCoarsestShift = kFractionBits - 8;

constexpr std::int64_t rounded(std::int64_t value, int shift) {
  return (value + (std::int64_t{1} << shift >> 1)) >> shift;
}

/// Place of pixel (x, y) along one axis: multiplications of 32 bit, which vectors have.
[[gnu::always_inline]] inline std::int32_t place(const PointAxis& axis, std::uint32_t x,
                                                 std::uint32_t y) {
  const std::uint32_t offset =
      axis.start + y * (axis.y + y * axis.yy) + x * (axis.x + y * axis.xy) + x * x * axis.xx;
  return axis.base + (static_cast<std::int32_t>(offset) >> PointAxis::kExtraBits);
}

/// Writes row `y` of two maps; bit x of `second` is set where the pixel is on `other`.
[[gnu::always_inline]] inline void write_row(const PointMap& first, const PointMap& other,
                                             std::uint16_t second, std::uint32_t y,
                                             CoordinateRow& out) {
  for (std::uint32_t x = 0; x < kTile; ++x) {
    const bool is_other = (second & (std::uint32_t{1} << x)) != 0;
    const std::int32_t u = place(first.u, x, y), v = place(first.v, x, y);
    const std::int32_t other_u = place(other.u, x, y), other_v = place(other.v, x, y);
    out[x] = {is_other ? other_u : u, is_other ? other_v : v};
  }
}

}  // namespace

CoordinateRow SplitTile::row(int y) const {
  CoordinateRow row;
  const PointMap first{Patch(sides[0])}, other{Patch(sides[1])};
  write_row(first, other, second[y], static_cast<std::uint32_t>(y), row);
  return row;
}

CoordinateTile SplitTile::pixels() const {
  CoordinateTile tile;
  const PointMap first{Patch(sides[0])}, other{Patch(sides[1])};
  for (std::uint32_t y = 0; y < kTile; ++y) write_row(first, other, second[y], y, tile[y]);
  return tile;
}

template <int Cell>
Stencil FineTile<Cell>::stencil(int i, int j) const {
  Stencil stencil;
  for (int k = 0; k < 4; ++k) std::copy_n(&nodes[j + k][i], 4, &stencil.at(-1, k - 1));
  return stencil;
}

template <int Cell>
Patch FineTile<Cell>::patch(int i, int j) const {
  constexpr int kBits = std::bit_width(static_cast<unsigned>(kCells)) - 1;
  return in_steps(Patch(stencil(i, j)), kBits);
}

template <int Cell>
CoordinateRow FineTile<Cell>::row(int y) const {
  CoordinateRow row;
  for (int i = 0; i < kCells; ++i) patch(i, y / Cell).row(y % Cell).write(Cell, &row[i * Cell]);
  return row;
}

template <int Cell>
CoordinateTile FineTile<Cell>::pixels() const {
  CoordinateTile tile;
  for (int j = 0; j < kCells; ++j) {
    for (int i = 0; i < kCells; ++i) {
      const Patch cell = patch(i, j);
      for (int y = 0; y < Cell; ++y) cell.row(y).write(Cell, &tile[j * Cell + y][i * Cell]);
    }
  }
  return tile;
}

template struct FineTile<8>;
template struct FineTile<4>;

namespace {

/// Number of places along a line of nodes, half a node apart: from half before the second to half
/// behind the third.
constexpr int kLine = 5;

/// Sixteen times the third-order curve through four nodes in a row, by Lagrange's weights.
std::array<Uv64, kLine> curve(Uv64 a, Uv64 b, Uv64 c, Uv64 d) {
  // Multiplies by shifts, as there is no vector multiplication of 64 bit.
  const auto times5 = [](Uv64 x) { return (x << 2) + x; };
  const auto times15 = [](Uv64 x) { return (x << 4) - x; };
  const Uv64 middle = b + c;
  return {times5(a - c) + times15(b) + d, b << 4, (middle << 3) + middle - a - d, c << 4,
          times5(d - b) + times15(c) + a};
}

/// A Coons patch between four nodes, in half steps from one before the first corner: between curves
/// through the rows and columns of nodes, less the part of the corners in both.
struct Coons {
  std::array<std::array<Coordinate, kLine>, kLine> nodes;

  explicit Coons(const Stencil& from) {
    const auto n = [&](int i, int j) { return Uv64{from.at(i, j).u, from.at(i, j).v}; };
    const auto row = [&](int j) { return curve(n(-1, j), n(0, j), n(1, j), n(2, j)); };
    const auto column = [&](int i) { return curve(n(i, -1), n(i, 0), n(i, 1), n(i, 2)); };
    std::array<Uv64, kLine> upper = row(0), lower = row(1), left = column(0), right = column(1);
    // The patch times 32 is, with i and j from -1 on, (2 - j) upper + j lower + (2 - i) left + i
    // right, where upper and lower are less eight times the line between their corners.
    Uv64 upper_line = ((n(0, 0) << 1) + n(0, 0) - n(1, 0)) << 3,
         lower_line = ((n(0, 1) << 1) + n(0, 1) - n(1, 1)) << 3;
    const Uv64 upper_step = (n(1, 0) - n(0, 0)) << 3, lower_step = (n(1, 1) - n(0, 1)) << 3;
    for (int j = 0; j < kLine; ++j) {
      right[j] -= left[j];
      left[j] = (left[j] << 1) - right[j];
    }
    constexpr int kBits = 5;
    for (int i = 0; i < kLine; ++i) {
      const Uv64 above = upper[i] - upper_line, step = lower[i] - lower_line - above;
      Uv64 between = (above << 1) - step + (1 << (kBits - 1));
      for (int j = 0; j < kLine; ++j) {
        const Uv64 node = (between + left[j]) >> kBits;
        nodes[j][i] = {static_cast<std::int32_t>(node[0]), static_cast<std::int32_t>(node[1])};
        between += step;
        left[j] += right[j];
      }
      upper_line += upper_step;
      lower_line += lower_step;
    }
  }
};

}  // namespace

FineTile<8> curved_tile(const Stencil& nodes) { return {Coons(nodes).nodes}; }

FineTile<4> curved_tile(const FineTile<8>& fine) {
  FineTile<4> tile;
  for (int cell_j = 0; cell_j < fine.kCells; ++cell_j) {
    for (int cell_i = 0; cell_i < fine.kCells; ++cell_i) {
      const Coons cell(fine.stencil(cell_i, cell_j));
      // The cells share the nodes between them: the last one sets those.
      for (int j = 0; j < kLine; ++j) {
        for (int i = 0; i < kLine; ++i) {
          // Outside of its cell each sets only the nodes that no other cell is closer to.
          if ((i == 0 && cell_i == 1) || (i == 4 && cell_i == 0)) continue;
          if ((j == 0 && cell_j == 1) || (j == 4 && cell_j == 0)) continue;
          tile.nodes[2 * cell_j + j][2 * cell_i + i] = cell.nodes[j][i];
        }
      }
    }
  }
  return tile;
}

std::optional<PackedTile> PackedTile::pack(const CoordinateTile& tile) {
  Coordinate least{INT32_MAX, INT32_MAX}, most{INT32_MIN, INT32_MIN};
  for (const CoordinateRow& row : tile) {
    for (const Coordinate& c : row) {
      if (!is_defined(c)) continue;
      least = {std::min(least.u, c.u), std::min(least.v, c.v)};
      most = {std::max(most.u, c.u), std::max(most.v, c.v)};
    }
  }
  const std::int64_t span =
      std::max(std::int64_t{most.u} - least.u, std::int64_t{most.v} - least.v);
  PackedTile packed;
  packed.least_ = least;
  while (rounded(span, packed.shift_) > kLargestOffset) ++packed.shift_;
  if (packed.shift_ > kCoarsestShift) return std::nullopt;
  for (int y = 0; y < kTile; ++y) {
    for (int x = 0; x < kTile; ++x) {
      const Coordinate& c = tile[y][x];
      const auto offset = [&](std::int64_t from_least) {
        return static_cast<std::uint16_t>(rounded(from_least, packed.shift_));
      };
      packed.offsets_[y][x] =
          is_defined(c)
              ? Offset{offset(std::int64_t{c.u} - least.u), offset(std::int64_t{c.v} - least.v)}
              : Offset{c.u == kBlind ? kBlindOffset : kOutsideOffset, 0};
    }
  }
  return packed;
}

CoordinateRow PackedTile::row(int y) const {
  CoordinateRow row;
  const Coordinate least = least_;
  const int shift = shift_;
  for (int x = 0; x < kTile; ++x) {
    const Offset& offset = offsets_[y][x];
    const bool is_marker = offset.u > kLargestOffset;
    const std::int32_t marker = offset.u == kBlindOffset ? kBlind : kOutside;
    row[x] = {is_marker ? marker : least.u + (offset.u << shift),
              is_marker ? 0 : least.v + (offset.v << shift)};
  }
  return row;
}

CoordinateTile PackedTile::pixels() const {
  CoordinateTile pixels;
  for (int y = 0; y < kTile; ++y) pixels[y] = row(y);
  return pixels;
}

std::uint32_t PixelTiles::add(const CoordinateTile& tile) {
  if (const auto packed = PackedTile::pack(tile)) {
    packed_.push_back(*packed);
    return static_cast<std::uint32_t>(packed_.size() - 1);
  }
  whole_.push_back(tile);
  return static_cast<std::uint32_t>(whole_.size() - 1) | kWhole;
}

CoordinateRow PixelTiles::row(std::uint32_t index, int y) const {
  return (index & kWhole) != 0 ? whole_[index & ~kWhole][y] : packed_[index].row(y);
}

CoordinateTile PixelTiles::pixels(std::uint32_t index) const {
  return (index & kWhole) != 0 ? whole_[index & ~kWhole] : packed_[index].pixels();
}

void PixelTiles::shrink_to_fit() {
  packed_.shrink_to_fit();
  whole_.shrink_to_fit();
}

std::size_t PixelTiles::bytes() const {
  return packed_.size() * sizeof(PackedTile) + whole_.size() * sizeof(CoordinateTile);
}

}  // namespace orbwatch::remap
