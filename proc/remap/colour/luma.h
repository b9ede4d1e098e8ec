// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>

namespace orbwatch::remap {

/// Weights of R', G' and B' in luma by BT.601, Q16; they add up to 1.
inline constexpr std::uint16_t kLumaRed = 19595, kLumaGreen = 38470, kLumaBlue = 7471;

/// Luma of an R'G'B' pixel by BT.601, rounded, 0..255.
constexpr std::uint8_t luma(const std::uint8_t* rgb) {
  constexpr std::uint32_t kHalf = 1U << 15;
  return static_cast<std::uint8_t>(
      (rgb[0] * kLumaRed + rgb[1] * kLumaGreen + rgb[2] * kLumaBlue + kHalf) >> 16);
}

/// The same for adjacent pixels.
void luma(const std::uint8_t* rgb, std::uint8_t* grey, int pixels);

}  // namespace orbwatch::remap
