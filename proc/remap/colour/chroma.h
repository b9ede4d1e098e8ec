// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <array>
#include <cstdint>

#include "proc/remap/colour/run.h"

namespace orbwatch::remap {

/// Chroma of a run in which two adjacent pixels share a sample; 128 has no colour.
using ChromaRun = std::array<std::uint8_t, kRun / 2>;
struct ChromaRuns {
  ChromaRun u, v;
};

inline constexpr int kNeutralChroma = 128;

/// Chroma (B - Y) / 1.772 and (R - Y) / 1.402 of JFIF from four times a mean colour: the weights
/// of each, Q16, add up to 0. The sum with kChromaOffset is not negative.
/// @{
struct ChromaWeights {
  std::int32_t red, green, blue;
};
inline constexpr ChromaWeights kWeightsOfU{-11058, -21710, 32768},
    kWeightsOfV{32768, -27439, -5329};
inline constexpr int kChromaBits = 16 + 2;
inline constexpr std::int32_t kChromaOffset =
    (kNeutralChroma << kChromaBits) + (1 << (kChromaBits - 1));
/// @}

/// The chroma of four times a mean colour, rounded.
constexpr std::uint8_t chroma_of(const ChromaWeights& weights, std::int32_t red, std::int32_t green,
                                 std::int32_t blue) {
  const std::int32_t sum =
      weights.red * red + weights.green * green + weights.blue * blue + kChromaOffset;
  return static_cast<std::uint8_t>(std::min(sum >> kChromaBits, 255));
}

/// Steps of the full range per step of the limited one, which has 224, Q14.
inline constexpr int kStretchBits = 14;
inline constexpr std::int16_t kStretch = (255 << kStretchBits) / 224;

}  // namespace orbwatch::remap
