#include "proc/remap/block_map.h"

#include <bit>

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

Both below_zero(Both value) { return value & (value >> 63); }
Both above_zero(Both value) { return value & ~(value >> 63); }

/// How far the pixels of any block lie from its corner, Q24; room for rounding is included.
struct Reach {
  Both low, high;
};
Reach reach(const BasicQuadratic<Both>& map, int blocks_x, int blocks_y) {
  // From a corner it is i (slope_x + i xx + j xy / 2) + j (slope_y + j yy + i xy / 2) to pixel
  // (i, j): the slopes up to 3/2, that is less than 2, pixels beyond the last corner, and that is 2
  // before the blocks' end, or the next power of two: vectors of 64 bit shift, but do not multiply.
  const int bits_x = std::bit_width(static_cast<unsigned>(kBlock * blocks_x - 1));
  const int bits_y = std::bit_width(static_cast<unsigned>(kBlock * blocks_y - 1));
  const auto until_last = [](Both slope, int bits) { return (slope << bits) - (slope << 1); };
  const Both xx = until_last(map.xx << 1, bits_x), xy = until_last(map.xy, bits_y);
  const Both yx = until_last(map.xy, bits_x), yy = until_last(map.yy << 1, bits_y);
  const Both low = below_zero(map.x + below_zero(xx) + below_zero(xy)) +
                   below_zero(map.y + below_zero(yx) + below_zero(yy));
  const Both high = above_zero(map.x + above_zero(xx) + above_zero(xy)) +
                    above_zero(map.y + above_zero(yx) + above_zero(yy));
  static_assert(kLast == 3);
  return {(low << 1) + low - kSlack, (high << 1) + high + kSlack};
}

bool fits(const BasicQuadratic<Both>& map, const Reach& pixels) {
  using Unsigned [[gnu::vector_size(16)]] = std::uint64_t;
  const auto is_too_curved = [](Both value) {
    return reinterpret_cast<Unsigned>(value + kMostCurvature) > 2 * kMostCurvature;
  };
  // A place is within the window's first pixel, the right or lower neighbour one further.
  const Both too_much = (pixels.high - pixels.low > (kWindow - 2) * kPixel) |
                        is_too_curved(map.xx) | is_too_curved(map.xy) | is_too_curved(map.yy);
  return (too_much[0] | too_much[1]) == 0;
}

/// Q24 to Q13 or Q18.
template <int bits>
Both rounded(Both value) {
  return (value + (1 << (bits - 1))) >> bits;
}

AxisPair<std::int64_t> pair(Both value) { return {value[0], value[1]}; }

WindowWalk window_walk(const BasicQuadratic<Both>& map, Both start) {
  // To Q32, and from pixels to blocks.
  static_assert(kBlock == 4);
  constexpr int kUpscale = 32 - (kFractionBits + kScaleBits);
  return {pair((map.value + start) << kUpscale),
          pair((map.x + (map.xx << 2)) << (kUpscale + 2)),
          pair((map.y + (map.yy << 2)) << (kUpscale + 2)),
          pair(map.xx << (kUpscale + 5)),
          pair(map.xy << (kUpscale + 4)),
          pair(map.yy << (kUpscale + 5))};
}

}  // namespace

std::optional<BlockMap> BlockMap::make(const Patch& patch, int blocks_x, int blocks_y,
                                       std::int32_t add_u, std::int32_t add_v) {
  std::optional<BlockMap> blocks;
  const BasicQuadratic<Both>& map = patch.axes();
  const Reach pixels = reach(map, blocks_x, blocks_y);
  if (!fits(map, pixels)) return blocks;

  const Both low = pixels.low >> kScaleBits;
  constexpr int kRowShift = kFractionBits - kRowFractionBits;
  constexpr std::int64_t kHalf = std::int64_t{1} << (kScaleBits - 1);
  const Both start = ((low + Both{add_u, add_v}) << kScaleBits) + Both{kHalf, kHalf << kRowShift};
  const Both slope_x = rounded<kScaleBits>(map.x), slope_y = rounded<kScaleBits>(map.y);
  const Both twice_xx = rounded<kCurvatureShift>(map.xx << 1);
  const Both xy = rounded<kCurvatureShift>(map.xy);
  const Both twice_yy = rounded<kCurvatureShift>(map.yy << 1);
  const Both offset = Both{0, kRowCentre << kRowShift} - low;
  const auto lanes = [&](int axis) {
    const auto narrow = [axis](Both value) { return static_cast<std::int16_t>(value[axis]); };
    return LaneShape{narrow(slope_x), narrow(slope_y),  narrow(twice_xx),
                     narrow(xy),      narrow(twice_yy), static_cast<std::uint16_t>(offset[axis])};
  };
  blocks.emplace();
  blocks->windows = window_walk(map, start);
  blocks->u = lanes(0);
  blocks->v = lanes(1);
  blocks->blocks_x = blocks_x;
  blocks->blocks_y = blocks_y;
  return blocks;
}

}  // namespace orbwatch::remap
