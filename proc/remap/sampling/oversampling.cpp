#include "proc/remap/sampling/oversampling.h"

#include <algorithm>
#include <cstdlib>
#include <utility>

#include "proc/remap/sampling/downsampling.h"

namespace orbwatch::remap {
namespace {

/// Steps further than that lead to another surface.
constexpr std::int32_t kFar = 64 << kFractionBits;

/// A quarter of the step from one pixel to a neighbour; 0 if that is on another surface.
Coordinate quarter_step(const Coordinate& from, const Coordinate& to) {
  if (!is_defined(to)) return {};
  const std::int64_t u = std::int64_t{to.u} - from.u, v = std::int64_t{to.v} - from.v;
  if (std::abs(u) > kFar || std::abs(v) > kFar) return {};
  return {static_cast<std::int32_t>(u / 4), static_cast<std::int32_t>(v / 4)};
}

/// A quarter of a step along one axis: the mean of that from the pixel before and that to the one
/// behind, or the one there is.
Coordinate mean_step(const Coordinate& here, const Coordinate* before, const Coordinate* behind) {
  Coordinate sum{};
  int count = 0;
  for (const auto& [neighbour, sign] : {std::pair{before, -1}, {behind, 1}}) {
    const Coordinate step = neighbour ? quarter_step(here, *neighbour) : Coordinate{};
    if (step.u == 0 && step.v == 0) continue;
    sum = {sum.u + sign * step.u, sum.v + sign * step.v};
    ++count;
  }
  return count == 2 ? Coordinate{sum.u / 2, sum.v / 2} : sum;
}

}  // namespace

void at_half_steps(const CoordinateTile& tile, int columns, int rows, int left, int top,
                   CoordinateTile& quarter) {
  const auto beside = [&](int x, int y) {
    return x < 0 || y < 0 || x >= columns || y >= rows ? nullptr : &tile[y][x];
  };
  for (int y = top / 2; y < std::min(rows, (top + kTile) / 2); ++y) {
    for (int x = left / 2; x < std::min(columns, (left + kTile) / 2); ++x) {
      const Coordinate& here = tile[y][x];
      Coordinate along_x{}, along_y{};
      if (is_defined(here)) {
        along_x = mean_step(here, beside(x - 1, y), beside(x + 1, y));
        along_y = mean_step(here, beside(x, y - 1), beside(x, y + 1));
      }
      for (const int j : {0, 1}) {
        for (const int i : {0, 1}) {
          const int right = 2 * i - 1, down = 2 * j - 1;
          quarter[2 * y - top + j][2 * x - left + i] = {
              here.u + right * along_x.u + down * along_y.u,
              here.v + right * along_x.v + down * along_y.v};
        }
      }
    }
  }
}

void average(const OversampledTile& tile, Layout layout, const TargetPlane& out) {
  const std::ptrdiff_t stride = OversampledTile::stride(layout);
  const BoxFilter filter = box_filter(packed(layout));
  for (int y = 0; y < out.rows; ++y) {
    const std::uint8_t* upper = tile.samples.data() + 2 * y * stride;
    filter(upper, upper + stride, out.data + y * out.stride, out.columns);
  }
}

}  // namespace orbwatch::remap
