// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <arm_neon.h>

namespace orbwatch::remap::neon {
namespace {

/// Each number of 16 bits shifted right by `bits`, 1 to 8, rounded, in 8 bits. In assembly, since
/// g++ copies the lower half before it writes the upper one.
template <int bits>
[[gnu::always_inline]] inline uint8x16_t rounded_shift(uint16x8_t low, uint16x8_t high) {
  uint8x16_t narrow;
  asm("rshrn %0.8b, %1.8h, %3\n\t"
      "rshrn2 %0.16b, %2.8h, %3"
      : "=&w"(narrow)
      : "w"(low), "w"(high), "i"(bits));
  return narrow;
}

}  // namespace
}  // namespace orbwatch::remap::neon
