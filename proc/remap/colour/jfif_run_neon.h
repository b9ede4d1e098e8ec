// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <arm_neon.h>

#include <cstdint>

#include "proc/remap/colour/chroma.h"
#include "proc/remap/colour/luma.h"

namespace orbwatch::remap {

/// luma() of half a run: one instruction rounds a sum and keeps its integer part.
[[gnu::always_inline]] inline uint16x8_t luma_half(uint8x8_t red, uint8x8_t green, uint8x8_t blue) {
  const uint16x8_t r = vmovl_u8(red), g = vmovl_u8(green), b = vmovl_u8(blue);
  uint32x4_t low = vmull_n_u16(vget_low_u16(r), kLumaRed);
  uint32x4_t high = vmull_high_n_u16(r, kLumaRed);
  low = vmlal_n_u16(low, vget_low_u16(g), kLumaGreen);
  high = vmlal_high_n_u16(high, g, kLumaGreen);
  low = vmlal_n_u16(low, vget_low_u16(b), kLumaBlue);
  high = vmlal_high_n_u16(high, b, kLumaBlue);
  return vrshrn_high_n_u32(vrshrn_n_u32(low, 16), high, 16);
}

[[gnu::always_inline]] inline void luma_run(const std::uint8_t* rgb, std::uint8_t* grey) {
  const uint8x16x3_t c = vld3q_u8(rgb);
  const uint16x8_t low =
      luma_half(vget_low_u8(c.val[0]), vget_low_u8(c.val[1]), vget_low_u8(c.val[2]));
  const uint16x8_t high =
      luma_half(vget_high_u8(c.val[0]), vget_high_u8(c.val[1]), vget_high_u8(c.val[2]));
  vst1q_u8(grey, vuzp1q_u8(vreinterpretq_u8_u16(low), vreinterpretq_u8_u16(high)));
}

/// `sum` and a weighted sample, modulo 2^32.
template <std::int32_t weight>
[[gnu::always_inline]] inline uint32x4_t weighted_low(uint32x4_t sum, uint16x8_t samples) {
  if constexpr (weight < 0) {
    return vmlsl_n_u16(sum, vget_low_u16(samples), static_cast<std::uint16_t>(-weight));
  } else {
    return vmlal_n_u16(sum, vget_low_u16(samples), static_cast<std::uint16_t>(weight));
  }
}
template <std::int32_t weight>
[[gnu::always_inline]] inline uint32x4_t weighted_high(uint32x4_t sum, uint16x8_t samples) {
  if constexpr (weight < 0) {
    return vmlsl_high_n_u16(sum, samples, static_cast<std::uint16_t>(-weight));
  } else {
    return vmlal_high_n_u16(sum, samples, static_cast<std::uint16_t>(weight));
  }
}

/// One component of chroma from four times the mean colours.
template <ChromaWeights w>
[[gnu::always_inline]] inline ChromaRun weighted(uint16x8_t red, uint16x8_t green,
                                                 uint16x8_t blue) {
  const uint32x4_t offset = vdupq_n_u32(kChromaOffset);
  const uint32x4_t low =
      weighted_low<w.blue>(weighted_low<w.green>(weighted_low<w.red>(offset, red), green), blue);
  const uint32x4_t high =
      weighted_high<w.blue>(weighted_high<w.green>(weighted_high<w.red>(offset, red), green), blue);
  const uint16x8_t words = vshrn_high_n_u32(vshrn_n_u32(low, 16), high, 16);
  ChromaRun chroma;
  vst1_u8(chroma.data(), vqshrn_n_u16(words, kChromaBits - 16));
  return chroma;
}

[[gnu::always_inline]] inline ChromaRuns chroma_run(const std::uint8_t* upper,
                                                    const std::uint8_t* lower) {
  const uint8x16x3_t a = vld3q_u8(upper), b = vld3q_u8(lower);
  const uint16x8_t red = vpadalq_u8(vpaddlq_u8(a.val[0]), b.val[0]);
  const uint16x8_t green = vpadalq_u8(vpaddlq_u8(a.val[1]), b.val[1]);
  const uint16x8_t blue = vpadalq_u8(vpaddlq_u8(a.val[2]), b.val[2]);
  return {weighted<kWeightsOfU>(red, green, blue), weighted<kWeightsOfV>(red, green, blue)};
}

[[gnu::always_inline]] inline ChromaRuns separated(const std::uint8_t* pairs) {
  const uint8x8x2_t both = vld2_u8(pairs);
  ChromaRuns chroma;
  vst1_u8(chroma.u.data(), both.val[0]);
  vst1_u8(chroma.v.data(), both.val[1]);
  return chroma;
}

/// The rounding product keeps a Q15 number's integer part: samples are doubled, not the factor.
[[gnu::always_inline]] inline void stretch(ChromaRun& chroma) {
  static_assert(kStretchBits == 14);
  const uint8x8_t samples = vld1_u8(chroma.data());
  const int16x8_t steps = vreinterpretq_s16_u16(vsubl_u8(samples, vdup_n_u8(kNeutralChroma)));
  const int16x8_t full = vqrdmulhq_n_s16(vaddq_s16(steps, steps), kStretch);
  vst1_u8(chroma.data(), vqmovun_s16(vaddq_s16(full, vdupq_n_s16(kNeutralChroma))));
}

}  // namespace orbwatch::remap
