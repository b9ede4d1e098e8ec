// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <cstdint>

#include "hal/frame/frame.h"
#include "hal/test_pattern/levels.h"

namespace orbwatch::hal {

inline constexpr int kNumberBits = 16;  ///< lowest bits of the number

/// Side of a square in a picture of that size, pixels. The whole row is shorter than the shorter
/// side, except in pictures below 32 pixels, which have no room for it.
constexpr int number_square(int width, int height) {
  return std::max(1, 2 * std::min(width, height) / (5 * kNumberBits));
}

/// Paints a frame's number into the first plane, so that tests can identify the picture downstream:
/// a row of kNumberBits squares, highest bit first, bright for 1, and as many of the complement, as
/// a check. The row is centred and begins a twentieth of the height below the middle. Neither
/// allocates nor throws.
void paint_number(FrameBuffer& buffer, std::uint64_t number);

}  // namespace orbwatch::hal
