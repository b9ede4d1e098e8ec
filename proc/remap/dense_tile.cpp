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

template struct FineTile<8>;
template struct FineTile<4>;

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
