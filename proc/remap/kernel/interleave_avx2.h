// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <immintrin.h>

#include <cstddef>
#include <cstdint>

#include "proc/remap/colour/run.h"

namespace orbwatch::remap::avx2 {
namespace {

/// Clips 16 bit numbers of two rows to bytes, row after row.
inline __m256i joined_rows(__m256i first, __m256i second) {
  return _mm256_permute4x64_epi64(_mm256_packus_epi16(first, second), _MM_SHUFFLE(3, 1, 2, 0));
}

/// Order of 16 pixels' samples in a part, `n`, of 16 bytes of three: byte k is of channel (16 n +
/// k) % 3 and of pixel (16 n + k) / 3. Of other channels bit 7 is set.
struct alignas(16) ThreesOrder {
  std::int8_t of[3][16];

  explicit constexpr ThreesOrder(int n) : of() {
    for (int k = 0; k < 16; ++k) {
      for (int channel = 0; channel < 3; ++channel) {
        const int place = 16 * n + k;
        of[channel][k] = static_cast<std::int8_t>(place % 3 == channel ? place / 3 : -1);
      }
    }
  }
  __m256i load(int channel) const {
    return _mm256_broadcastsi128_si256(
        _mm_load_si128(reinterpret_cast<const __m128i*>(of[channel])));
  }
};
constexpr ThreesOrder kThreesOrder[3]{ThreesOrder(0), ThreesOrder(1), ThreesOrder(2)};

/// Writes the samples of two runs interleaved, `stride` bytes apart.
[[gnu::always_inline]] inline void store_threes(__m256i first, __m256i second, __m256i third,
                                                std::uint8_t* to, std::ptrdiff_t stride) {
#pragma GCC unroll 3
  for (int n = 0; n < 3; ++n) {
    const ThreesOrder& order = kThreesOrder[n];
    const __m256i part =
        _mm256_or_si256(_mm256_or_si256(_mm256_shuffle_epi8(first, order.load(0)),
                                        _mm256_shuffle_epi8(second, order.load(1))),
                        _mm256_shuffle_epi8(third, order.load(2)));
    _mm_storeu_si128(reinterpret_cast<__m128i*>(to + kRun * n), _mm256_castsi256_si128(part));
    _mm_storeu_si128(reinterpret_cast<__m128i*>(to + stride + kRun * n),
                     _mm256_extracti128_si256(part, 1));
  }
}

}  // namespace
}  // namespace orbwatch::remap::avx2
