// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <immintrin.h>

#include <cstddef>
#include <cstdint>

#include "proc/remap/kernel/bilinear.h"
#include "proc/remap/kernel/kernel_map.h"
#include "proc/remap/kernel/layout.h"

// Windows of the kernel for AVX2, and the interpolation along u.

namespace orbwatch::remap::avx2 {
namespace {

inline __m128i load128(const void* from) {
  return _mm_loadu_si128(static_cast<const __m128i*>(from));
}
inline __m256i each(int value) { return _mm256_set1_epi16(static_cast<short>(value)); }

/// Positions and weights for the interpolation of a block's pixels.
struct Places {
  static constexpr int kTables = 4;

  /// Indices of the two upper neighbours in the four tables of a channel, and of the two lower
  /// ones. Bit 7 is set, so that vpshufb yields 0, if they lie below the first table, below the
  /// second, above the third, and above the fourth.
  __m256i upper[kTables], lower[kTables];
  __m256i across;  ///< weights w - 128, -w along u
  __m256i v;

  /// `by_halves`: the tables hold the left halves of their two rows, then the right ones.
  Places(__m256i u, __m256i lanes_v, bool by_halves) : v(lanes_v) {
    constexpr int kRowShift = kRowFractionBits - 3;
    const __m256i whole =
        _mm256_or_si256(_mm256_srli_epi16(u, kFractionBits),
                        _mm256_and_si256(_mm256_srli_epi16(v, kRowShift), each(7 << 3)));
    const __m256i left_right =
        _mm256_add_epi16(_mm256_mullo_epi16(whole, each(0x0101)), each(0x0100));
    find(left_right, by_halves, upper);
    find(_mm256_add_epi8(left_right, _mm256_set1_epi8(kWindow)), by_halves, lower);
    const __m256i w =
        _mm256_and_si256(_mm256_srli_epi16(u, kFractionBits - kWeightBits), each(kUnitWeight - 1));
    across = _mm256_xor_si256(_mm256_mullo_epi16(w, each(1 - 256)), each(kUnitWeight));
  }

 private:
  /// From indices in all rows of kWindow.
  [[gnu::always_inline]] static void find(__m256i index, bool by_halves, __m256i (&in)[kTables]) {
    constexpr int kSize = 2 * kWindow;
    if (by_halves) {
      // Swaps the bits of the half and of the row.
      const __m256i changes = _mm256_broadcastsi128_si256(
          _mm_setr_epi8(0, 0, 0, 0, 12, 12, 12, 12, 12, 12, 12, 12, 0, 0, 0, 0));
      index = _mm256_xor_si256(index, _mm256_shuffle_epi8(changes, index));
    }
    const auto plus = [index](int value) {
      return _mm256_add_epi8(index, _mm256_set1_epi8(static_cast<char>(value)));
    };
    in[0] = plus(128 - kSize);
    in[1] = plus(128 - 2 * kSize);
    in[2] = plus(-2 * kSize);
    in[3] = plus(-3 * kSize);
  }
};

/// One byte of each pixel's sample, times -kUnitWeight: interpolated along u in the rows above and
/// below.
struct Rows {
  __m256i top, bottom;
};

/// Part of its windows that a tile's blocks need, from the first pixel on. Fewer rows take fewer
/// tables; five pixels of three bytes fit one register and are sorted in fewer steps.
struct WindowPart {
  int columns = kWindow, rows = kWindow;
};
inline constexpr WindowPart kWhole;
inline constexpr int kFewColumns = 5, kFewRows = 6;

/// Two rows of a window of each channel, 8 bytes each: tables for vpshufb, of one window in both
/// halves, or `of_two` windows.
template <int pixel_bytes, bool of_two, int columns>
struct Tables {
  static constexpr bool kFives = pixel_bytes == 3 && columns == kFewColumns;
  /// True for tables of left halves of both rows and then their right halves.
  static constexpr bool kByHalves = pixel_bytes > 2 && !kFives;

  __m256i channels[pixel_bytes];

  /// `beside`: the upper halves' window.
  [[gnu::always_inline]] Tables(const std::uint8_t* from, const std::uint8_t* beside,
                                std::ptrdiff_t stride) {
    if constexpr (pixel_bytes == 1) {
      const auto row = [](const std::uint8_t* at) {
        return _mm256_broadcastq_epi64(_mm_loadu_si64(at));
      };
      channels[0] = _mm256_blend_epi32(row(from), row(from + stride), 0xcc);
      if constexpr (of_two) {
        const __m256i other = _mm256_blend_epi32(row(beside), row(beside + stride), 0xcc);
        channels[0] = _mm256_blend_epi32(channels[0], other, 0xf0);
      }
    } else if constexpr (pixel_bytes == 2) {
      const __m256i first = by_channel(row_start(from, beside));
      const __m256i second = by_channel(row_start(from + stride, beside + stride));
      channels[0] = _mm256_unpacklo_epi64(first, second);
      channels[1] = _mm256_unpackhi_epi64(first, second);
    } else if constexpr (kFives) {
      const auto sorted = [](__m256i pixels, __m128i order) {
        return _mm256_shuffle_epi8(pixels, _mm256_broadcastsi128_si256(order));
      };
      constexpr char no = -1;
      const __m128i two = _mm_setr_epi8(0, 3, 6, 9, 12, no, no, no, 1, 4, 7, 10, 13, no, no, no);
      const __m128i last =
          _mm_setr_epi8(2, 5, 8, 11, 14, no, no, no, no, no, no, no, no, no, no, no);
      const __m128i below =
          _mm_setr_epi8(no, no, no, no, no, no, no, no, 2, 5, 8, 11, 14, no, no, no);
      const __m256i first = row_start(from, beside);
      const __m256i second = row_start(from + stride, beside + stride);
      channels[0] = _mm256_unpacklo_epi64(sorted(first, two), sorted(second, two));
      channels[1] = _mm256_unpackhi_epi64(sorted(first, two), sorted(second, two));
      channels[2] = _mm256_or_si256(sorted(first, last), sorted(second, below));
    } else {
      const Quarters here(from, stride);
      if constexpr (of_two) {
        const Quarters there(beside, stride);
        join(here.low, there.low, channels[0], channels[1]);
        join(here.high, there.high, channels[2], channels[pixel_bytes == 4 ? 3 : 2]);
      } else {
        channels[0] = _mm256_permute4x64_epi64(here.low, 0x88);
        channels[1] = _mm256_permute4x64_epi64(here.low, 0xdd);
        channels[2] = _mm256_permute4x64_epi64(here.high, 0x88);
        if constexpr (pixel_bytes == 4) channels[3] = _mm256_permute4x64_epi64(here.high, 0xdd);
      }
    }
  }

 private:
  /// The first 16 bytes of one window's row in both halves, or of two.
  static __m256i row_start(const std::uint8_t* lower, const std::uint8_t* upper) {
    const __m256i one = _mm256_broadcastsi128_si256(load128(lower));
    return of_two ? _mm256_inserti128_si256(one, load128(upper), 1) : one;
  }
  /// Four pixels of both rows in each half, 8 bytes of a channel after another.
  struct Quarters {
    __m256i low, high;  ///< channels 0 and 1, 2 and 3

    Quarters(const std::uint8_t* from, std::ptrdiff_t stride) {
      const __m256i first = by_channel(halves(from)), second = by_channel(halves(from + stride));
      low = _mm256_unpacklo_epi32(first, second);
      high = _mm256_unpackhi_epi32(first, second);
    }
  };
  /// Makes tables of two channels; of three byte pixels, `second` is `first`, which is set last.
  [[gnu::always_inline]] static void join(__m256i here, __m256i there, __m256i& first,
                                          __m256i& second) {
    const __m256i left = _mm256_permute2x128_si256(here, there, 0x20);
    const __m256i right = _mm256_permute2x128_si256(here, there, 0x31);
    second = _mm256_unpackhi_epi64(left, right);
    first = _mm256_unpacklo_epi64(left, right);
  }
  /// Four pixels in each half. Of three byte pixels, only the row's 24 bytes are read: from the
  /// lower half's fifth byte on.
  static __m256i halves(const std::uint8_t* from) {
    if constexpr (pixel_bytes == 4) {
      return _mm256_loadu_si256(reinterpret_cast<const __m256i*>(from));
    } else {
      const __m256i row = _mm256_setr_epi32(0, -1, -1, -1, -1, -1, -1, 0);
      return _mm256_maskload_epi32(reinterpret_cast<const int*>(from - 4), row);
    }
  }
  /// Sorts the bytes of each half's pixels by channel.
  static __m256i by_channel(__m256i pixels) {
    const __m256i order =
        pixel_bytes == 3
            ? _mm256_setr_epi8(4, 7, 10, 13, 5, 8, 11, 14, 6, 9, 12, 15, -1, -1, -1, -1,  //
                               0, 3, 6, 9, 1, 4, 7, 10, 2, 5, 8, 11, -1, -1, -1, -1)
        : pixel_bytes == 2 ? _mm256_broadcastsi128_si256(_mm_setr_epi8(0, 2, 4, 6, 8, 10, 12, 14, 1,
                                                                       3, 5, 7, 9, 11, 13, 15))
                           : _mm256_broadcastsi128_si256(_mm_setr_epi8(0, 4, 8, 12, 1, 5, 9, 13, 2,
                                                                       6, 10, 14, 3, 7, 11, 15));
    return _mm256_shuffle_epi8(pixels, order);
  }
};

/// Interpolates along u all channels that the layout reads of a window, 8 rows that are `stride`
/// apart; for the upper halves, of the window `beside`, if `of_two`.
template <Layout layout, bool of_two, WindowPart part>
[[gnu::always_inline]] inline void interpolate_rows(const std::uint8_t* from,
                                                    const std::uint8_t* beside,
                                                    std::ptrdiff_t stride, const Places& places,
                                                    Rows (&rows)[info(layout).out_bytes()]) {
  constexpr int kChannels = info(layout).out_bytes(), kBytes = info(layout).pixel_bytes;
  constexpr int kFirst = info(layout).first, kEvery = info(layout).every;
  const auto tables = [&](int row) __attribute__((always_inline)) {
    return Tables<kBytes, of_two, part.columns>(from + row * stride, beside + row * stride, stride);
  };
  // A lookup in the first or last table hits its neighbour too. Those tables are therefore the
  // exclusive or of both, and the results are combined by exclusive or.
  __m256i upper[kChannels], lower[kChannels];
  {
    const auto first = tables(0), second = tables(2);
#pragma GCC unroll 4
    for (int k = 0; k < kChannels; ++k) {
      const __m256i near = second.channels[kFirst + k * kEvery];
      const __m256i far = _mm256_xor_si256(first.channels[kFirst + k * kEvery], near);
      upper[k] = _mm256_xor_si256(_mm256_shuffle_epi8(far, places.upper[0]),
                                  _mm256_shuffle_epi8(near, places.upper[1]));
      lower[k] = _mm256_xor_si256(_mm256_shuffle_epi8(far, places.lower[0]),
                                  _mm256_shuffle_epi8(near, places.lower[1]));
    }
  }
  const auto third = tables(4);
  const auto add = [](__m256i& sum, __m256i a) { sum = _mm256_xor_si256(sum, a); };
#pragma GCC unroll 4
  for (int k = 0; k < kChannels; ++k) {
    const __m256i near = third.channels[kFirst + k * kEvery];
    add(upper[k], _mm256_shuffle_epi8(near, places.upper[2]));
    add(lower[k], _mm256_shuffle_epi8(near, places.lower[2]));
  }
  if constexpr (part.rows > kFewRows) {
    const auto fourth = tables(6);
#pragma GCC unroll 4
    for (int k = 0; k < kChannels; ++k) {
      const int channel = kFirst + k * kEvery;
      const __m256i far = _mm256_xor_si256(third.channels[channel], fourth.channels[channel]);
      add(upper[k], _mm256_shuffle_epi8(far, places.upper[3]));
      add(lower[k], _mm256_shuffle_epi8(far, places.lower[3]));
    }
  }
#pragma GCC unroll 4
  for (int k = 0; k < kChannels; ++k) {
    rows[k] = {_mm256_maddubs_epi16(upper[k], places.across),
               _mm256_maddubs_epi16(lower[k], places.across)};
  }
}

}  // namespace
}  // namespace orbwatch::remap::avx2
