// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>

namespace orbwatch::remap {

/// Factors and offsets of YuvToRgb, Q14; see there.
struct YuvCoefficients {
  std::uint16_t y, red_v, green_u, green_v, blue_u;
  std::int32_t red, green, blue;
};

/// The samples of a whole tile that become R'G'B'.
struct YuvRows {
  const std::uint8_t* luminance;  ///< rows of kTile
  const std::uint8_t* chroma;     ///< rows of pairs (U, V), each for two pixels
  std::ptrdiff_t chroma_stride;
  int rows_of_chroma;  ///< rows of pixels that share one of chroma: 1 or 2
  bool blue_first;     ///< output order is B G R, not R G B
};

}  // namespace orbwatch::remap
