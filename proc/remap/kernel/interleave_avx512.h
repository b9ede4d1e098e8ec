// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <immintrin.h>

#include <cstddef>
#include <cstdint>
#include <cstring>

#include "proc/remap/colour/run.h"

namespace orbwatch::remap::avx512 {
namespace {

/// Order of 64 pixels' samples in part `n` of three: byte k of the part is of channel (64 n + k) %
/// 3 and of pixel (64 n + k) / 3. The samples of the second channel are numbered from 64 on.
struct alignas(64) ThreesOrder {
  std::uint8_t first_and_second[64];
  std::uint8_t third[64];
  std::uint64_t is_third;

  explicit constexpr ThreesOrder(int n) : first_and_second(), third(), is_third(0) {
    for (int k = 0; k < 64; ++k) {
      const int channel = (64 * n + k) % 3, pixel = (64 * n + k) / 3;
      first_and_second[k] = static_cast<std::uint8_t>(channel == 1 ? 64 + pixel : pixel);
      third[k] = static_cast<std::uint8_t>(pixel);
      is_third |= std::uint64_t{channel == 2} << k;
    }
  }
};
constexpr ThreesOrder kThreesOrder[3]{ThreesOrder(0), ThreesOrder(1), ThreesOrder(2)};

/// Writes the samples of 64 pixels interleaved: four runs, `stride` bytes apart.
inline void store_threes(__m512i first, __m512i second, __m512i third, std::uint8_t* to,
                         std::ptrdiff_t stride) {
  alignas(64) std::uint8_t apart[4 * 3 * kRun];
  const bool is_one = stride == 3 * kRun;
  std::uint8_t* const out = is_one ? to : apart;
  for (int n = 0; n < 3; ++n) {
    const ThreesOrder& order = kThreesOrder[n];
    const __m512i two =
        _mm512_permutex2var_epi8(first, _mm512_load_si512(order.first_and_second), second);
    _mm512_storeu_si512(
        out + 64 * n,
        _mm512_mask_permutexvar_epi8(two, order.is_third, _mm512_load_si512(order.third), third));
  }
  if (is_one) return;
  for (int row = 0; row < 4; ++row)
    std::memcpy(to + row * stride, apart + 3 * kRun * row, 3 * kRun);
}

}  // namespace
}  // namespace orbwatch::remap::avx512
