#include "proc/remap/kernel/point_map.h"

namespace orbwatch::remap {
namespace {

PointAxis point_axis(const Quadratic& axis) {
  constexpr int kBits = PatchRow::kScaleBits, kDropped = kBits - PointAxis::kExtraBits;
  const auto rounded = [](std::int64_t term) {
    return static_cast<std::uint32_t>((term + (1 << (kDropped - 1))) >> kDropped);
  };
  // What the base leaves of the value, and a half for the last shift.
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

PointMap::PointMap(const Patch& patch) : u(point_axis(patch.u())), v(point_axis(patch.v())) {}

}  // namespace orbwatch::remap
