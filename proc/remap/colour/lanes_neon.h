// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <arm_neon.h>

#include <cstdint>

#include "proc/remap/colour/run.h"

namespace orbwatch::remap {

/// Four times the even and the odd samples of a run: sums are then Q16, and one instruction adds
/// two of them and keeps their integer part.
struct EvenOdd {
  [[gnu::always_inline]] explicit EvenOdd(const SampleRun& run) {
    const uint16x8_t words = vreinterpretq_u16_u8(vld1q_u8(run.data()));
    const uint16x8_t mask = vdupq_n_u16(4 * 0xff);
    even = vandq_u16(vshlq_n_u16(words, 2), mask);
    odd = vandq_u16(vshrq_n_u16(words, 6), mask);
  }
  uint16x8_t even, odd;
};

/// A Q16 number, modulo 2^32, for each pair of a run's pixels.
struct Lanes {
  Lanes() = default;
  [[gnu::always_inline]] explicit Lanes(std::int32_t q14)
      : low(vdupq_n_u32(static_cast<std::uint32_t>(4 * q14))), high(low) {}

  [[gnu::always_inline]] Lanes plus(uint16x8_t samples, std::uint16_t q14) const {
    Lanes sum;
    sum.low = vmlal_n_u16(low, vget_low_u16(samples), q14);
    sum.high = vmlal_high_n_u16(high, samples, q14);
    return sum;
  }
  [[gnu::always_inline]] Lanes minus(uint16x8_t samples, std::uint16_t q14) const {
    Lanes rest;
    rest.low = vmlsl_n_u16(low, vget_low_u16(samples), q14);
    rest.high = vmlsl_high_n_u16(high, samples, q14);
    return rest;
  }

  uint32x4_t low, high;
};

/// The sums clipped to 8 bits, in the upper half of each number.
[[gnu::always_inline]] inline uint16x8_t clipped_sum(const Lanes& a, const Lanes& b) {
  const uint16x8_t sum = vaddhn_high_u32(vaddhn_u32(a.low, b.low), a.high, b.high);
  return vqshluq_n_s16(vreinterpretq_s16_u16(sum), 8);
}

/// The samples of a run, rounded down and clipped: the even ones are even + shared, the odd ones
/// odd + shared.
[[gnu::always_inline]] inline SampleRun clipped_sums(const Lanes& even, const Lanes& odd,
                                                     const Lanes& shared) {
  const uint16x8_t words = vsriq_n_u16(clipped_sum(odd, shared), clipped_sum(even, shared), 8);
  SampleRun run;
  vst1q_u8(run.data(), vreinterpretq_u8_u16(words));
  return run;
}

/// (sample - black) q14 of each, rounded and clipped. The rounding product keeps a Q15 number's
/// integer part: samples are doubled, not the factor.
[[gnu::always_inline]] inline SampleRun scaled(const SampleRun& samples, std::uint8_t black,
                                               std::uint16_t q14) {
  const uint8x16_t all = vld1q_u8(samples.data());
  const uint16x8_t twice_black = vdupq_n_u16(2 * black);
  const auto product = [&](uint16x8_t twice) {
    const int16x8_t steps = vreinterpretq_s16_u16(vsubq_u16(twice, twice_black));
    return vqrdmulhq_n_s16(steps, static_cast<std::int16_t>(q14));
  };
  const int16x8_t low = product(vshll_n_u8(vget_low_u8(all), 1));
  const int16x8_t high = product(vshll_high_n_u8(all, 1));
  SampleRun run;
  vst1q_u8(run.data(), vqmovun_high_s16(vqmovun_s16(low), high));
  return run;
}

}  // namespace orbwatch::remap
