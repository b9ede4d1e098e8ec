// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <immintrin.h>

#include <cstddef>
#include <cstdint>

#include "proc/remap/colour/yuv_rows.h"
#include "proc/remap/kernel/interleave_avx512.h"

// Colour conversion of the kernel for AVX-512: four rows at a time, 32 bit for each pixel, one
// register for a row.

namespace orbwatch::remap::avx512 {
namespace {

/// Contributions to each colour, Q14, of the pairs (U, V) of two rows of chroma.
struct ChromaTerms {
  __m512i red, green, blue;

  ChromaTerms(__m512i pairs, const YuvCoefficients& c) {
    const auto of_pair = [](std::uint16_t u, std::uint16_t v) {
      return _mm512_set1_epi32(static_cast<std::int32_t>(std::uint32_t{v} << 16 | u));
    };
    red = _mm512_add_epi32(_mm512_set1_epi32(c.red), _mm512_madd_epi16(pairs, of_pair(0, c.red_v)));
    green = _mm512_sub_epi32(_mm512_set1_epi32(c.green),
                             _mm512_madd_epi16(pairs, of_pair(c.green_u, c.green_v)));
    // The factor exceeds 15 bits.
    const __m512i u = _mm512_and_si512(pairs, _mm512_set1_epi32(0xffff));
    blue = _mm512_add_epi32(_mm512_set1_epi32(c.blue),
                            _mm512_mullo_epi32(u, _mm512_set1_epi32(c.blue_u)));
  }
};

/// Repeats each pair for the two pixels that share it: of the first eight of 16 pairs, or of the
/// last eight.
inline __m512i doubled(__m512i pairs, bool last) {
  const __m512i first = _mm512_set_epi32(7, 7, 6, 6, 5, 5, 4, 4, 3, 3, 2, 2, 1, 1, 0, 0);
  return _mm512_permutexvar_epi32(last ? _mm512_add_epi32(first, _mm512_set1_epi32(8)) : first,
                                  pairs);
}

/// Rounds four rows of Q14 numbers down and clips them to bytes, row after row.
inline __m512i clipped(const __m512i (&rows)[4]) {
  const auto whole = [&](int n) { return _mm512_srai_epi32(rows[n], 14); };
  const __m512i upper = _mm512_packs_epi32(whole(0), whole(1));
  const __m512i lower = _mm512_packs_epi32(whole(2), whole(3));
  // Lanes hold four pixels of each row in turn.
  const __m512i order = _mm512_set_epi32(15, 11, 7, 3, 14, 10, 6, 2, 13, 9, 5, 1, 12, 8, 4, 0);
  return _mm512_permutexvar_epi32(order, _mm512_packus_epi16(upper, lower));
}

/// Implements Kernel::write_rgb.
inline void write_rgb(const YuvRows& yuv, const YuvCoefficients& coefficients, std::uint8_t* out,
                      std::ptrdiff_t stride) {
  const __m512i gain = _mm512_set1_epi32(coefficients.y);
  const auto chroma = [&](int row) {
    const std::uint8_t* const from = yuv.chroma + row / yuv.rows_of_chroma * yuv.chroma_stride;
    return _mm256_cvtepu8_epi16(_mm_loadu_si128(reinterpret_cast<const __m128i*>(from)));
  };
  const auto terms_of = [&](int first, int second) {
    return ChromaTerms(_mm512_inserti64x4(_mm512_castsi256_si512(chroma(first)), chroma(second), 1),
                       coefficients);
  };
  const int distance = yuv.rows_of_chroma;  // rows between different rows of chroma
  for (int y = 0; y < kTile; y += 4, out += 4 * stride) {
    const ChromaTerms upper = terms_of(y, y + distance);
    const ChromaTerms lower = distance == 1 ? terms_of(y + 2, y + 3) : upper;
    __m512i red[4], green[4], blue[4];
    for (int n = 0; n < 4; ++n) {
      const auto* const from = reinterpret_cast<const __m128i*>(yuv.luminance + (y + n) * kRun);
      const __m512i luminance =
          _mm512_madd_epi16(_mm512_cvtepu8_epi32(_mm_loadu_si128(from)), gain);
      const ChromaTerms& terms = n < 2 ? upper : lower;
      const bool is_second = distance == 1 ? n % 2 == 1 : n >= 2;
      red[n] = _mm512_add_epi32(luminance, doubled(terms.red, is_second));
      green[n] = _mm512_add_epi32(luminance, doubled(terms.green, is_second));
      blue[n] = _mm512_add_epi32(luminance, doubled(terms.blue, is_second));
    }
    const __m512i first = clipped(red), third = clipped(blue);
    yuv.blue_first ? store_threes(third, clipped(green), first, out, stride)
                   : store_threes(first, clipped(green), third, out, stride);
  }
}

}  // namespace
}  // namespace orbwatch::remap::avx512
