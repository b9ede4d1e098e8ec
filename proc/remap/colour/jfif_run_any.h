// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <array>
#include <cstdint>

#include "proc/remap/colour/chroma.h"
#include "proc/remap/colour/luma.h"

namespace orbwatch::remap {

/// luma() of a run of R'G'B' pixels.
inline void luma_run(const std::uint8_t* rgb, std::uint8_t* grey) {
  for (int x = 0; x < kRun; ++x) grey[x] = luma(rgb + 3 * x);
}

/// Chroma of the mean colour of each two by two pixels of two R'G'B' rows, rounded.
inline ChromaRuns chroma_run(const std::uint8_t* upper, const std::uint8_t* lower) {
  std::array<std::int32_t, kRun> r, g, b;
  for (int x = 0; x < kRun; ++x) {
    r[x] = upper[3 * x] + lower[3 * x];
    g[x] = upper[3 * x + 1] + lower[3 * x + 1];
    b[x] = upper[3 * x + 2] + lower[3 * x + 2];
  }
  ChromaRuns chroma;
  for (int i = 0; i < kRun / 2; ++i) {
    const std::int32_t red = r[2 * i] + r[2 * i + 1], green = g[2 * i] + g[2 * i + 1],
                       blue = b[2 * i] + b[2 * i + 1];
    chroma.u[i] = chroma_of(kWeightsOfU, red, green, blue);
    chroma.v[i] = chroma_of(kWeightsOfV, red, green, blue);
  }
  return chroma;
}

/// Separates a run of pairs.
inline ChromaRuns separated(const std::uint8_t* pairs) {
  ChromaRuns chroma;
  for (int i = 0; i < kRun / 2; ++i) chroma.u[i] = pairs[2 * i];
  for (int i = 0; i < kRun / 2; ++i) chroma.v[i] = pairs[2 * i + 1];
  return chroma;
}

/// Stretches chroma from the limited range, whose 224 steps become 255, rounded.
inline void stretch(ChromaRun& chroma) {
  constexpr int kHalf = 1 << (kStretchBits - 1);
  for (std::uint8_t& c : chroma) {
    const int full = ((c - kNeutralChroma) * kStretch + kHalf) >> kStretchBits;
    c = static_cast<std::uint8_t>(std::clamp(full + kNeutralChroma, 0, 255));
  }
}

}  // namespace orbwatch::remap
