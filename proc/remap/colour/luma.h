// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>

namespace orbwatch::remap {

/// Luma of an R'G'B' pixel by BT.601, 0..255.
constexpr std::uint8_t luma(const std::uint8_t* rgb) {
  return static_cast<std::uint8_t>((rgb[0] * 19595U + rgb[1] * 38470U + rgb[2] * 7471U + 32768U) >>
                                   16);
}

/// The same for adjacent pixels.
void luma(const std::uint8_t* rgb, std::uint8_t* grey, int pixels);

}  // namespace orbwatch::remap
