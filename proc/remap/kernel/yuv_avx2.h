// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <immintrin.h>

#include <cstddef>
#include <cstdint>

#include "proc/remap/colour/yuv_rows.h"
#include "proc/remap/kernel/interleave_avx2.h"

// Colour conversion of the kernel for AVX2: a row at a time, 32 bit for each pixel. Halves of a
// row's two registers hold pixels 0 to 3 and 8 to 11, and 4 to 7 and 12 to 15.

namespace orbwatch::remap::avx2 {
namespace {

/// Two registers for a row, Q14.
struct RowOfSums {
  __m256i left, right;

  RowOfSums plus(const RowOfSums& other) const {
    return {_mm256_add_epi32(left, other.left), _mm256_add_epi32(right, other.right)};
  }
  /// Rounded down, 16 bit each, in the order of the row.
  __m256i whole() const {
    return _mm256_packs_epi32(_mm256_srai_epi32(left, 14), _mm256_srai_epi32(right, 14));
  }
};

/// Contributions of a row of chroma to each colour.
class ChromaSums {
 public:
  ChromaSums(const std::uint8_t* from, const YuvCoefficients& c) {
    const auto of_pair = [](int u, int v) {
      return _mm256_set1_epi32(static_cast<std::int32_t>(static_cast<std::uint32_t>(v) << 16 |
                                                         static_cast<std::uint16_t>(u)));
    };
    const __m256i pairs =
        _mm256_cvtepu8_epi16(_mm_loadu_si128(reinterpret_cast<const __m128i*>(from)));
    const auto sums = [&](std::int32_t offset, __m256i factors) {
      const __m256i sum =
          _mm256_add_epi32(_mm256_set1_epi32(offset), _mm256_madd_epi16(pairs, factors));
      return RowOfSums{_mm256_unpacklo_epi32(sum, sum), _mm256_unpackhi_epi32(sum, sum)};
    };
    red = sums(c.red, of_pair(0, c.red_v));
    green = sums(c.green, of_pair(-c.green_u, -c.green_v));
    // The factor exceeds 15 bits: 1 is added after rounding.
    blue = sums(c.blue, of_pair(c.blue_u - kOne, 0));
    const __m256i u = _mm256_and_si256(pairs, _mm256_set1_epi32(0xffff));
    whole_blue = _mm256_or_si256(u, _mm256_slli_epi32(u, 16));
  }

  RowOfSums red, green, blue;
  __m256i whole_blue;  ///< further contribution to blue, 16 bit each

 private:
  static constexpr int kOne = 1 << 14;
};

/// Implements Kernel::write_rgb.
inline void write_rgb(const YuvRows& yuv, const YuvCoefficients& coefficients, std::uint8_t* out,
                      std::ptrdiff_t stride) {
  const __m256i gain = _mm256_set1_epi32(coefficients.y);
  struct Row {
    __m256i red, green, blue;
  };
  const auto row = [&](int y, const ChromaSums& chroma) __attribute__((always_inline)) {
    const auto* const from = reinterpret_cast<const __m128i*>(yuv.luminance + y * kRun);
    const __m256i words = _mm256_cvtepu8_epi16(_mm_loadu_si128(from));
    const __m256i zero = _mm256_setzero_si256();
    const RowOfSums luminance{_mm256_madd_epi16(_mm256_unpacklo_epi16(words, zero), gain),
                              _mm256_madd_epi16(_mm256_unpackhi_epi16(words, zero), gain)};
    return Row{luminance.plus(chroma.red).whole(), luminance.plus(chroma.green).whole(),
               _mm256_add_epi16(luminance.plus(chroma.blue).whole(), chroma.whole_blue)};
  };
  for (int y = 0; y < kTile; y += 2, out += 2 * stride) {
    const std::uint8_t* const from = yuv.chroma + y / yuv.rows_of_chroma * yuv.chroma_stride;
    const ChromaSums upper(from, coefficients);
    const Row first = row(y, upper);
    const Row second = yuv.rows_of_chroma == 2
                           ? row(y + 1, upper)
                           : row(y + 1, ChromaSums(from + yuv.chroma_stride, coefficients));
    const __m256i red = joined_rows(first.red, second.red);
    const __m256i green = joined_rows(first.green, second.green);
    const __m256i blue = joined_rows(first.blue, second.blue);
    yuv.blue_first ? store_threes(blue, green, red, out, stride)
                   : store_threes(red, green, blue, out, stride);
  }
}

}  // namespace
}  // namespace orbwatch::remap::avx2
