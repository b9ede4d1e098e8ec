// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <array>
#include <bit>
#include <cstddef>
#include <cstdint>

#include "proc/remap/colour/run.h"

namespace orbwatch::remap {

inline constexpr std::size_t kPairs = kRun / 2;
using PairSamples = std::array<std::uint16_t, kPairs>;

/// The even and the odd samples of a run.
struct EvenOdd {
  [[gnu::always_inline]] explicit EvenOdd(const SampleRun& run) {
    static_assert(std::endian::native == std::endian::little);
    const auto words = std::bit_cast<PairSamples>(run);
    for (std::size_t i = 0; i < kPairs; ++i) even[i] = words[i] & 0xff;
    for (std::size_t i = 0; i < kPairs; ++i) odd[i] = words[i] >> 8;
  }
  PairSamples even, odd;
};

/// A Q14 number for each pair of a run's pixels.
struct Lanes {
  Lanes() = default;
  [[gnu::always_inline]] explicit Lanes(std::int32_t q14) { values.fill(q14); }

  [[gnu::always_inline]] Lanes plus(const PairSamples& samples, std::uint16_t q14) const {
    Lanes sum;
    for (std::size_t i = 0; i < kPairs; ++i) sum.values[i] = values[i] + product(samples[i], q14);
    return sum;
  }
  [[gnu::always_inline]] Lanes minus(const PairSamples& samples, std::uint16_t q14) const {
    Lanes rest;
    for (std::size_t i = 0; i < kPairs; ++i) rest.values[i] = values[i] - product(samples[i], q14);
    return rest;
  }

  std::array<std::int32_t, kPairs> values;

 private:
  /// Both factors have 16 bits.
  [[gnu::always_inline]] static std::int32_t product(std::uint16_t sample, std::uint16_t q14) {
    return static_cast<std::int32_t>(std::uint32_t{sample} * q14);
  }
};

[[gnu::always_inline]] inline PairSamples clipped_sums(const Lanes& a, const Lanes& b) {
  std::array<std::int16_t, kPairs> sums;
  for (std::size_t i = 0; i < kPairs; ++i) {
    sums[i] = static_cast<std::int16_t>((a.values[i] + b.values[i]) >> 14);
  }
  PairSamples clipped;
  for (std::size_t i = 0; i < kPairs; ++i) {
    clipped[i] = static_cast<std::uint16_t>(std::clamp<std::int16_t>(sums[i], 0, 255));
  }
  return clipped;
}

/// The samples of a run, rounded down and clipped: the even ones are even + shared, the odd ones
/// odd + shared.
[[gnu::always_inline]] inline SampleRun clipped_sums(const Lanes& even, const Lanes& odd,
                                                     const Lanes& shared) {
  const PairSamples low = clipped_sums(even, shared), high = clipped_sums(odd, shared);
  PairSamples words;
  for (std::size_t i = 0; i < kPairs; ++i) {
    words[i] = static_cast<std::uint16_t>(low[i] | high[i] << 8);
  }
  return std::bit_cast<SampleRun>(words);
}

/// (sample - black) q14 of each, rounded and clipped.
[[gnu::always_inline]] inline SampleRun scaled(const SampleRun& samples, std::uint8_t black,
                                               std::uint16_t q14) {
  const EvenOdd each(samples);
  const std::int32_t offset = (1 << 13) - black * q14;
  return clipped_sums(Lanes(0).plus(each.even, q14), Lanes(0).plus(each.odd, q14), Lanes(offset));
}

}  // namespace orbwatch::remap
