#include "proc/remap/block_map.h"

#include <algorithm>

namespace orbwatch::remap {
namespace {

constexpr int kScaleBits = PatchRow::kScaleBits;
constexpr std::int64_t kPixel = std::int64_t{1} << (kFractionBits + kScaleBits);
constexpr int kLast = kBlock - 1;

// Q18 from Q24. More curvature would overflow 16 bit lanes (3 * 3 * 3584 < 2^15), and is far beyond
// what fits a window.
constexpr int kCurvatureShift = 6;
constexpr std::int64_t kMostCurvature = std::int64_t{3584} << kCurvatureShift;

// What rounding of the lanes may add on either side of a block, Q24.
constexpr std::int64_t kSlack = std::int64_t{32} << kScaleBits;

constexpr std::int64_t below_zero(std::int64_t value) { return value & (value >> 63); }
constexpr std::int64_t above_zero(std::int64_t value) { return value & ~(value >> 63); }

constexpr bool fits_curvature(std::int64_t value) {
  return value >= -kMostCurvature && value <= kMostCurvature;
}

/// How far the pixels of any block lie from its corner, Q24; room for rounding is included.
struct Reach {
  std::int64_t low, high;
};
Reach reach(const Quadratic& map, int blocks_x, int blocks_y) {
  // From a corner it is i (slope_x + i xx + j xy / 2) + j (slope_y + j yy + i xy / 2) to pixel
  // (i, j): the slopes up to 3/2, that is less than 2, pixels beyond the last corner.
  const std::int64_t last_x = kBlock * (blocks_x - 1) + 2, last_y = kBlock * (blocks_y - 1) + 2;
  const std::int64_t xx = 2 * last_x * map.xx, xy = last_y * map.xy;
  const std::int64_t yx = last_x * map.xy, yy = 2 * last_y * map.yy;
  const std::int64_t low = below_zero(map.x + below_zero(xx) + below_zero(xy)) +
                           below_zero(map.y + below_zero(yx) + below_zero(yy));
  const std::int64_t high = above_zero(map.x + above_zero(xx) + above_zero(xy)) +
                            above_zero(map.y + above_zero(yx) + above_zero(yy));
  return {kLast * low - kSlack, kLast * high + kSlack};
}

/// Q24 to Q13 or Q18.
template <int bits>
constexpr std::int16_t rounded(std::int64_t value) {
  return static_cast<std::int16_t>((value + (1 << (bits - 1))) >> bits);
}

bool fill(std::int64_t AxisPair<std::int64_t>::*axis, WindowWalk& windows, LaneShape& lanes,
          const Quadratic& map, int blocks_x, int blocks_y, std::int64_t start, int centre) {
  const Reach pixels = reach(map, blocks_x, blocks_y);
  // A place is within the window's first pixel, the right or lower neighbour one further.
  if (pixels.high - pixels.low > (kWindow - 2) * kPixel) return false;
  if (!fits_curvature(map.xx) || !fits_curvature(map.xy) || !fits_curvature(map.yy)) return false;

  const std::int64_t low = pixels.low >> kScaleBits;
  constexpr int kUpscale = 32 - (kFractionBits + kScaleBits);
  constexpr std::int64_t kStep = std::int64_t{kBlock} << kUpscale;
  windows.value.*axis = (map.value + start + (low << kScaleBits)) << kUpscale;
  windows.step_x.*axis = kStep * (map.x + kBlock * map.xx);
  windows.step_y.*axis = kStep * (map.y + kBlock * map.yy);
  windows.xx.*axis = 2 * kBlock * kStep * map.xx;
  windows.xy.*axis = kBlock * kStep * map.xy;
  windows.yy.*axis = 2 * kBlock * kStep * map.yy;
  lanes.slope_x = rounded<kScaleBits>(map.x);
  lanes.slope_y = rounded<kScaleBits>(map.y);
  lanes.twice_xx = rounded<kCurvatureShift>(2 * map.xx);
  lanes.xy = rounded<kCurvatureShift>(map.xy);
  lanes.twice_yy = rounded<kCurvatureShift>(2 * map.yy);
  lanes.offset = static_cast<std::uint16_t>(centre - low);
  return true;
}

}  // namespace

std::optional<BlockMap> BlockMap::make(const Patch& patch, int blocks_x, int blocks_y,
                                       std::int32_t add_u, std::int32_t add_v) {
  using Pair = AxisPair<std::int64_t>;
  constexpr int kRowScaleBits = kScaleBits + kFractionBits - kRowFractionBits;
  const std::int64_t start_u = (std::int64_t{add_u} << kScaleBits) + (1 << (kScaleBits - 1));
  const std::int64_t start_v = (std::int64_t{add_v} << kScaleBits) + (1 << (kRowScaleBits - 1));
  std::optional<BlockMap> map(std::in_place);
  map->blocks_x = blocks_x;
  map->blocks_y = blocks_y;
  if (!fill(&Pair::u, map->windows, map->u, patch.u(), blocks_x, blocks_y, start_u, 0) ||
      !fill(&Pair::v, map->windows, map->v, patch.v(), blocks_x, blocks_y, start_v,
            kRowCentre << (kFractionBits - kRowFractionBits))) {
    map.reset();
  }
  return map;
}

}  // namespace orbwatch::remap
