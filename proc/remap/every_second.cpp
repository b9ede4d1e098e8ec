#include "proc/remap/every_second.h"

#include <array>
#include <cassert>
#include <cstdint>
#include <cstring>

#include "proc/remap/coordinate.h"

namespace orbwatch::remap {
namespace {

template <class Pixel>
void take(const TargetPlane& fine, const TargetPlane& out) {
  std::array<Pixel, kTile> row;
  std::array<Pixel, kTile / 2> half;
  const int rows = out.rows;
  const std::uint8_t* from = fine.data;
  std::uint8_t* to = out.data;
  for (int y = 0; y < rows; ++y, from += fine.stride, to += out.stride) {
    std::memcpy(row.data(), from, sizeof row);
    for (std::size_t x = 0; x < half.size(); ++x) half[x] = row[2 * x];
    std::memcpy(to, half.data(), sizeof half);
  }
}

}  // namespace

void take_every_second_row(const TargetPlane& fine, int row_bytes, const TargetPlane& out) {
  constexpr int kUnit = 8;  // a constant, for std::memcpy to be no call
  assert(row_bytes % kUnit == 0 && fine.rows >= 2 * out.rows);
  const std::uint8_t* from = fine.data;
  std::uint8_t* to = out.data;
  for (int y = 0; y < out.rows; ++y, from += 2 * fine.stride, to += out.stride) {
    for (int x = 0; x < row_bytes; x += kUnit) std::memcpy(to + x, from + x, kUnit);
  }
}

void take_every_second_column(const TargetPlane& fine, int pixel_bytes, const TargetPlane& out) {
  assert(fine.columns == kTile && fine.rows >= out.rows);
  switch (pixel_bytes) {
    case 1:
      return take<std::uint8_t>(fine, out);
    case 2:
      return take<std::uint16_t>(fine, out);
    case 3:
      return take<std::array<std::uint8_t, 3>>(fine, out);
    default:
      return take<std::uint32_t>(fine, out);
  }
}

}  // namespace orbwatch::remap
