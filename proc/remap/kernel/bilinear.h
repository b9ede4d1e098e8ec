// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <cstring>

#include "proc/remap/grid/coordinate.h"
#include "proc/remap/kernel/kernel.h"

// Interpolation of four samples in integers that every kernel reproduces. 8 bit samples are
// weighted along u in Q7 and then along v in Q16; 16 bit samples by products of Q7 weights.
// Rounding to Q7 is done by adding kHalfWeight to the coordinate beforehand (`added_u`, `added_v`).

namespace orbwatch::remap {

inline constexpr int kWeightBits = 7;
inline constexpr std::int32_t kUnitWeight = 1 << kWeightBits;
inline constexpr std::int32_t kHalfWeight = 1 << (kFractionBits - kWeightBits - 1);

constexpr std::int32_t added_u(Layout) { return kHalfWeight; }
constexpr std::int32_t added_v(Layout layout) {
  return info(layout).sample_bytes == 2 ? kHalfWeight : 0;
}

/// The clamp of v below the last row for point-by-point samples, Q13: v's fraction then fits the 16
/// bit lanes of 8 bit samples. It moves samples by at most 1/8192 px.
template <Layout layout>
inline constexpr std::int32_t kShortOfLastRow = info(layout).sample_bytes == 1 ? 1 : 0;

constexpr std::int32_t weight(std::int32_t c) {
  return c >> (kFractionBits - kWeightBits) & (kUnitWeight - 1);
}

/// Interpolates four 8 bit samples: upper left, upper right, lower left, lower right. The rows'
/// mean plus their difference times v - 1/2 needs no mask that extracts v's fraction from a 16 bit
/// lane: a left shift leaves v - 1/2 as a signed number.
constexpr std::uint8_t interpolate8(std::int32_t a, std::int32_t b, std::int32_t c, std::int32_t d,
                                    Coordinate at) {
  const std::int32_t u = weight(at.u);
  const std::int32_t v = ((at.v & ((1 << kFractionBits) - 1)) << (16 - kFractionBits)) - (1 << 15);
  const std::int32_t top = a * (kUnitWeight - u) + b * u, bottom = c * (kUnitWeight - u) + d * u;
  const std::int32_t twice = top + bottom + (((bottom - top) * v + (1 << 14)) >> 15);
  return static_cast<std::uint8_t>((twice + kUnitWeight) >> (kWeightBits + 1));
}

/// Interpolates four 16 bit samples.
constexpr std::uint16_t interpolate16(std::uint32_t a, std::uint32_t b, std::uint32_t c,
                                      std::uint32_t d, Coordinate at) {
  const auto u = static_cast<std::uint32_t>(weight(at.u));
  const auto v = static_cast<std::uint32_t>(weight(at.v));
  const std::uint32_t left = kUnitWeight - u, upper = kUnitWeight - v;
  const std::uint32_t sum = a * left * upper + b * u * upper + c * left * v + d * u * v;
  return static_cast<std::uint16_t>((sum + kUnitWeight * kUnitWeight / 2) >> (2 * kWeightBits));
}

/// The four pixels around a coordinate.
struct Neighbours {
  const std::uint8_t* upper_left;
  const std::uint8_t* upper_right;
  const std::uint8_t* lower_left;
  const std::uint8_t* lower_right;
};

/// Interpolates all samples of one pixel of `layout`; `at` includes added_u and added_v.
template <Layout layout>
void interpolate_pixel(const Neighbours& n, Coordinate at, std::uint8_t* out) {
  constexpr LayoutInfo kInfo = info(layout);
  for (int k = 0; k < kInfo.samples; ++k) {
    if constexpr (kInfo.sample_bytes == 1) {
      const int offset = kInfo.first + k * kInfo.every;
      out[k] = interpolate8(n.upper_left[offset], n.upper_right[offset], n.lower_left[offset],
                            n.lower_right[offset], at);
    } else {
      const auto read = [k](const std::uint8_t* pixel) {
        std::uint16_t sample = 0;
        std::memcpy(&sample, pixel + 2 * k, 2);
        return sample;
      };
      const std::uint16_t value = interpolate16(read(n.upper_left), read(n.upper_right),
                                                read(n.lower_left), read(n.lower_right), at);
      std::memcpy(out + 2 * k, &value, 2);
    }
  }
}

}  // namespace orbwatch::remap
