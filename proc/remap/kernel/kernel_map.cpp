// SPDX-License-Identifier: Apache-2.0
#include "proc/remap/kernel/kernel_map.h"

#include <algorithm>
#include <bit>

namespace orbwatch::remap {
namespace {

constexpr int kScaleBits = PatchRow::kScaleBits;
constexpr int kSlopeBits = UvQuadratic::kSlopeBits;
constexpr int kSlopeShift = kScaleBits - kSlopeBits;
constexpr int kLast = kBlock - 1;

// Shift from Q24 to Q18. More curvature would overflow 16 bit lanes (3 * 3 * 3584 < 2^15), and is
// far beyond the limit for a window.
constexpr int kCurvatureShift = 6;
constexpr std::int32_t kMostCurvature = 3584 << kCurvatureShift;

// Largest effect of rounding the lanes on either side of a block, Q20.
constexpr std::int32_t kSlack = 32 << kSlopeBits;

UvXy32 below_zero(UvXy32 value) { return value < 0 ? value : 0; }
UvXy32 above_zero(UvXy32 value) { return value > 0 ? value : 0; }

/// Bounds of the pixels of any block relative to its corner, Q20: least u and v, greatest u and v.
/// Room for rounding is included.
UvXy32 reach_of(const UvQuadratic& map, int columns, int rows) {
  // From a corner to pixel (i, j) it is i (slope_x + i xx + j xy / 2) + j (slope_y + j yy + i xy /
  // 2): the slopes up to 3/2, that is less than 2, pixels beyond the last corner, which is 2 before
  // the blocks' end; for both axes the longer one's.
  const int last = std::max(columns, rows) - 2;
  const UvXy32 along = (map.curve * (2 * last)) >> kSlopeShift;
  const UvXy32 across = (map.cross * last) >> kSlopeShift;
  const UvXy32 low = below_zero(map.slope + below_zero(along) + below_zero(across));
  const UvXy32 high = above_zero(map.slope + above_zero(along) + above_zero(across));
  const UvXy32 sum = __builtin_shufflevector(low, high, 0, 1, 4, 5) +
                     __builtin_shufflevector(low, high, 2, 3, 6, 7);
  return kLast * sum + UvXy32{-kSlack, -kSlack, kSlack, kSlack};
}

/// True: the curvature fits into lanes.
bool is_flat_enough(const UvQuadratic& map) {
  using Unsigned [[gnu::vector_size(16)]] = std::uint32_t;
  const auto is_too_curved = [](UvXy32 value) {
    return reinterpret_cast<Unsigned>(value + kMostCurvature) > 2 * kMostCurvature;
  };
  const UvXy32 too_much = is_too_curved(map.curve) | is_too_curved(map.cross);
  const Uv64 any = reinterpret_cast<Uv64>(too_much);
  return (any[0] | any[1]) == 0;
}

using UvXy16 [[gnu::vector_size(8)]] = std::int16_t;

/// Each number times 2^shift in 64 bits.
struct Widened {
  Uv64 along_x, along_y;
};
template <int shift>
Widened widened(UvXy32 value) {
  static_assert(std::endian::native == std::endian::little);
  const UvXy32 low = value << shift, high = value >> (32 - shift);
  return {reinterpret_cast<Uv64>(__builtin_shufflevector(low, high, 0, 4, 1, 5)),
          reinterpret_cast<Uv64>(__builtin_shufflevector(low, high, 2, 6, 3, 7))};
}

/// `start`: Q24, origin of the windows relative to the patch's corner.
WindowWalk window_walk(const UvQuadratic& map, Uv64 start) {
  // Converts to Q32, and from pixels to blocks.
  static_assert(kBlock == 4);
  constexpr int kUpscale = 32 - (kFractionBits + kScaleBits);
  const Widened step = widened<kUpscale + 4>((map.slope << (kSlopeShift - 2)) + map.curve);
  const Widened growth = widened<kUpscale + 5>(map.curve);
  return {(map.value + start) << kUpscale,
          step.along_x,
          step.along_y,
          growth.along_x,
          growth.along_y,
          widened<kUpscale + 4>(map.cross).along_x};
}

template <int shift>
UvXy32 rounded(UvXy32 value) {
  return (value + (1 << (shift - 1))) >> shift;
}
UvXy16 narrow(UvXy32 value) { return __builtin_convertvector(value, UvXy16); }

LaneShape lane_shape(const UvQuadratic& map, UvXy32 offset) {
  const UvXy32 cross = rounded<kCurvatureShift>(map.cross);
  const UvXy32 last = __builtin_shufflevector(cross, offset, 0, 1, 4, 5);
  struct Registers {
    UvXy16 slope, curve, last;
  };
  // Twice the curvature has one fraction bit less.
  return std::bit_cast<LaneShape>(Registers{narrow(rounded<kSlopeBits>(map.slope)),
                                            narrow(rounded<kCurvatureShift - 1>(map.curve)),
                                            narrow(last)});
}

PointAxis point_axis(const Quadratic& axis) {
  constexpr int kBits = PatchRow::kScaleBits, kDropped = kBits - PointAxis::kExtraBits;
  const auto rounded = [](std::int64_t term) {
    return static_cast<std::uint32_t>((term + (1 << (kDropped - 1))) >> kDropped);
  };
  // The part of the value below the base's last bit, plus a half for the last shift.
  const std::int64_t rest = axis.value & ((std::int64_t{1} << kBits) - 1);
  constexpr std::uint32_t kHalf = 1U << (PointAxis::kExtraBits - 1);
  return {static_cast<std::int32_t>(axis.value >> kBits),
          rounded(rest) + kHalf,
          rounded(axis.x),
          rounded(axis.y),
          rounded(axis.xy),
          rounded(axis.xx),
          rounded(axis.yy)};
}

}  // namespace

bool BlockMap::fit(const Patch& patch, int columns, int rows, const Uv64& rounding) {
  const UvQuadratic& map = patch.axes();
  const UvXy32 pixels = reach_of(map, columns, rows);
  reach = {pixels[2] - pixels[0], pixels[3] - pixels[1]};
  if (!is_within(kWindow, kWindow) || !is_flat_enough(map)) return false;

  constexpr int kRowShift = kFractionBits - kRowFractionBits;
  const UvXy32 low = pixels >> kSlopeBits;
  const Uv64 start = widened<kScaleBits>(low).along_x + rounding;
  windows = window_walk(map, start);
  lanes = lane_shape(map, UvXy32{0, kRowCentre << kRowShift, 0, 0} - low);
  blocks_x = static_cast<int>(static_cast<unsigned>(columns) / kBlock);
  blocks_y = static_cast<int>(static_cast<unsigned>(rows) / kBlock);
  return true;
}

PointMap::PointMap(const Patch& patch) : u(point_axis(patch.u())), v(point_axis(patch.v())) {}

}  // namespace orbwatch::remap
