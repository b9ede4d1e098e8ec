#include "proc/remap/dense_tile.h"

#include <algorithm>

namespace orbwatch::remap {
namespace {

constexpr std::uint16_t kBlindOffset = UINT16_MAX;
constexpr std::uint16_t kOutsideOffset = UINT16_MAX - 1;
constexpr std::int64_t kLargestOffset = UINT16_MAX - 2;
// Rounding to steps of 1/256 px loses 1/360 px at most, which the grid's tolerance has room for.
constexpr int kCoarsestShift = kFractionBits - 8;

constexpr std::int64_t rounded(std::int64_t value, int shift) {
  return (value + (std::int64_t{1} << shift >> 1)) >> shift;
}

}  // namespace

CoordinateRow SplitTile::row(int y) const {
  std::array<PatchRow, 2> on{Patch(sides[0]).row(y), Patch(sides[1]).row(y)};
  CoordinateRow row;
  for (int x = 0; x < kTile; ++x) {
    row[x] = on[second[y] >> x & 1].current();
    for (PatchRow& side : on) side.step();
  }
  return row;
}

template <int Cell>
Stencil FineTile<Cell>::stencil(int i, int j) const {
  Stencil stencil;
  for (int k = 0; k < 4; ++k) std::copy_n(&nodes[j + k][i], 4, &stencil.at(-1, k - 1));
  return stencil;
}

template <int Cell>
CoordinateRow FineTile<Cell>::row(int y) const {
  constexpr int kStride = kTile / Cell;  // a pixel in sixteenths of a cell
  CoordinateRow row;
  for (int i = 0; i < kCells; ++i) {
    PatchRow current = Patch(stencil(i, y / Cell)).row(y % Cell * kStride).stride(kStride);
    for (int x = 0; x < Cell; ++x, current.step()) row[i * Cell + x] = current.current();
  }
  return row;
}

template <int Cell>
CoordinateTile FineTile<Cell>::pixels() const {
  constexpr int kStride = kTile / Cell;
  CoordinateTile tile;
  for (int j = 0; j < kCells; ++j) {
    for (int i = 0; i < kCells; ++i) {
      const Patch patch(stencil(i, j));
      for (int y = 0; y < Cell; ++y) {
        PatchRow current = patch.row(y * kStride).stride(kStride);
        Coordinate* row = &tile[j * Cell + y][i * Cell];
        for (int x = 0; x < Cell; ++x, current.step()) row[x] = current.current();
      }
    }
  }
  return tile;
}

template struct FineTile<8>;
template struct FineTile<4>;

namespace {

// Lagrange's weights, in sixteenths, of four nodes in a row at half a node before the second one,
// there, and so on.
constexpr int kHalves = 5;
constexpr std::array<std::array<std::int64_t, 4>, kHalves> kLagrange{
    {{5, 15, -5, 1}, {0, 16, 0, 0}, {-1, 9, 9, -1}, {0, 0, 16, 0}, {1, -5, 15, 5}}};

/// One coordinate of a curved tile's nodes.
class Coons {
 public:
  Coons(const Stencil& nodes, std::int32_t Coordinate::*member) : nodes_(nodes), member_(member) {
    for (int side = 0; side < 2; ++side) {
      for (int k = 0; k < kHalves; ++k) {
        for (int n = 0; n < 4; ++n) {
          rows_[side][k] += kLagrange[k][n] * node(n - 1, side);
          columns_[side][k] += kLagrange[k][n] * node(side, n - 1);
        }
      }
    }
  }

  /// i, j count halves, from one before the first corner.
  std::int32_t at(int i, int j) const {
    const std::int64_t right = i - 1, left = 2 - right, below = j - 1, above = 2 - below;
    const std::int64_t curves =
        above * rows_[0][i] + below * rows_[1][i] + left * columns_[0][j] + right * columns_[1][j];
    const std::int64_t corners = above * (left * node(0, 0) + right * node(1, 0)) +
                                 below * (left * node(0, 1) + right * node(1, 1));
    return static_cast<std::int32_t>((curves - 8 * corners + 16) >> 5);
  }

 private:
  std::int64_t node(int i, int j) const { return nodes_.at(i, j).*member_; }

  const Stencil& nodes_;
  std::int32_t Coordinate::*member_;
  /// Times sixteen: along the upper and lower row, the left and right column of nodes.
  std::array<std::array<std::int64_t, kHalves>, 2> rows_{};
  std::array<std::array<std::int64_t, kHalves>, 2> columns_{};
};

}  // namespace

FineTile<8> curved_tile(const Stencil& nodes) {
  const Coons u(nodes, &Coordinate::u), v(nodes, &Coordinate::v);
  FineTile<8> tile;
  for (int j = 0; j < tile.kNodes; ++j) {
    for (int i = 0; i < tile.kNodes; ++i) tile.nodes[j][i] = {u.at(i, j), v.at(i, j)};
  }
  return tile;
}

FineTile<4> curved_tile(const FineTile<8>& fine) {
  FineTile<4> tile;
  for (int cell_j = 0; cell_j < fine.kCells; ++cell_j) {
    for (int cell_i = 0; cell_i < fine.kCells; ++cell_i) {
      const Stencil nodes = fine.stencil(cell_i, cell_j);
      const Coons u(nodes, &Coordinate::u), v(nodes, &Coordinate::v);
      // The cells share the nodes between them: the last one to come sets those.
      for (int j = 0; j < kHalves; ++j) {
        for (int i = 0; i < kHalves; ++i) {
          // Outside of its cell each gives only what no other cell is closer to.
          if ((i == 0 && cell_i == 1) || (i == 4 && cell_i == 0)) continue;
          if ((j == 0 && cell_j == 1) || (j == 4 && cell_j == 0)) continue;
          tile.nodes[2 * cell_j + j][2 * cell_i + i] = {u.at(i, j), v.at(i, j)};
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
  for (int x = 0; x < kTile; ++x) {
    const Offset& offset = offsets_[y][x];
    if (offset.u <= kLargestOffset) {
      row[x] = {least_.u + (offset.u << shift_), least_.v + (offset.v << shift_)};
    } else {
      row[x] = {offset.u == kBlindOffset ? kBlind : kOutside, 0};
    }
  }
  return row;
}

}  // namespace orbwatch::remap
