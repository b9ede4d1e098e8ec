// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <arm_neon.h>

#include <cstddef>
#include <cstdint>

#include "proc/remap/sampling/sharpen_run.h"
#include "proc/remap/sampling/sharpening.h"

namespace orbwatch::remap {

/// Sharpens 16 adjacent samples that have neighbours, with NEON intrinsics: compilers do not
/// generate the instruction that keeps the upper half of a product, nor those that round and clip.
/// See sharpening.h.
class RunSharpener {
 public:
  [[gnu::always_inline]] RunSharpener(const RowsAround& rows, const SharpeningGains& gains)
      : rows_(rows), gains_(vtrn1q_s16(vdupq_n_s16(gains[0]), vdupq_n_s16(gains[1]))) {}

  /// `even`: index of the first sample in its row, an even number.
  [[gnu::always_inline]] void operator()(std::ptrdiff_t even, std::uint8_t* out) const {
    const std::ptrdiff_t step = rows_.pixel_samples;
    const std::uint8_t *const above = rows_.above + even, *const row = rows_.row + even,
                              *const below = rows_.below + even;
    const uint8x16_t up_left = vld1q_u8(above - step), up = vld1q_u8(above),
                     up_right = vld1q_u8(above + step), left = vld1q_u8(row - step),
                     here = vld1q_u8(row), right = vld1q_u8(row + step),
                     down_left = vld1q_u8(below - step), down = vld1q_u8(below),
                     down_right = vld1q_u8(below + step);
    const Sums beside = plus(plus(sums(up, down), left), right);
    const Sums corners = plus(plus(sums(up_left, up_right), down_left), down_right);
    const uint8x16_t weight = vdupq_n_u8(60);
    const uint8x8_t low = vget_low_u8(here), high = vget_high_u8(here);
    vst1q_u8(
        out + even,
        vcombine_u8(sharpened(low, vmull_u8(low, vget_low_u8(weight)), beside.low, corners.low),
                    sharpened(high, vmull_high_u8(here, weight), beside.high, corners.high)));
  }

 private:
  struct Sums {
    uint16x8_t low, high;
  };
  [[gnu::always_inline]] static Sums sums(uint8x16_t a, uint8x16_t b) {
    return {vaddl_u8(vget_low_u8(a), vget_low_u8(b)), vaddl_high_u8(a, b)};
  }
  [[gnu::always_inline]] static Sums plus(const Sums& sums, uint8x16_t a) {
    return {vaddw_u8(sums.low, vget_low_u8(a)), vaddw_high_u8(sums.high, a)};
  }

  [[gnu::always_inline]] uint8x8_t sharpened(uint8x8_t samples, uint16x8_t weighted,
                                             uint16x8_t beside, uint16x8_t corners) const {
    const int16x8_t difference =
        vreinterpretq_s16_u16(vmlsq_n_u16(vmlsq_n_u16(weighted, beside, 11), corners, 4));
    const int16x8_t sample = vreinterpretq_s16_u16(vmovl_u8(samples));
    return vqmovun_s16(vrsraq_n_s16(sample, vqdmulhq_s16(difference, gains_), 3));
  }

  RowsAround rows_;
  int16x8_t gains_;
};

}  // namespace orbwatch::remap
