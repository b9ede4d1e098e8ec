// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <arm_neon.h>

#include <cstdint>

#include "proc/remap/sampling/box_run.h"

namespace orbwatch::remap {

// NEON intrinsics: compilers do not generate the instructions that add neighbours.

template <>
[[gnu::always_inline]] inline void box_run<Layout::One8>(const std::uint8_t* upper,
                                                         const std::uint8_t* lower,
                                                         std::uint8_t* out) {
  vst1_u8(out, vrshrn_n_u16(vpadalq_u8(vpaddlq_u8(vld1q_u8(upper)), vld1q_u8(lower)), 2));
}

/// Pixels are read as words, so that the even and the odd ones are separated.
template <>
[[gnu::always_inline]] inline void box_run<Layout::Two8>(const std::uint8_t* upper,
                                                         const std::uint8_t* lower,
                                                         std::uint8_t* out) {
  const auto pixels = [](const std::uint8_t* row) __attribute__((always_inline)) {
    return vld2_u16(reinterpret_cast<const std::uint16_t*>(row));
  };
  const uint16x4x2_t above = pixels(upper), below = pixels(lower);
  uint16x8_t sum = vaddl_u8(vreinterpret_u8_u16(above.val[0]), vreinterpret_u8_u16(above.val[1]));
  sum = vaddw_u8(sum, vreinterpret_u8_u16(below.val[0]));
  sum = vaddw_u8(sum, vreinterpret_u8_u16(below.val[1]));
  vst1_u8(out, vrshrn_n_u16(sum, 2));
}

template <>
[[gnu::always_inline]] inline void box_run<Layout::One16>(const std::uint8_t* upper,
                                                          const std::uint8_t* lower,
                                                          std::uint8_t* out) {
  const uint16x8_t above = vreinterpretq_u16_u8(vld1q_u8(upper));
  const uint16x8_t below = vreinterpretq_u16_u8(vld1q_u8(lower));
  vst1_u8(out, vreinterpret_u8_u16(vrshrn_n_u32(vpadalq_u16(vpaddlq_u16(above), below), 2)));
}

}  // namespace orbwatch::remap
