// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <immintrin.h>

#include <cstddef>
#include <cstdint>
#include <cstring>

#include "proc/image/image_view.h"
#include "proc/remap/colour/colour_table.h"
#include "proc/remap/colour/run.h"
#include "proc/remap/colour/yuv420_tile.h"
#include "proc/remap/kernel/interleave_avx512.h"

// Colour lookup of the kernel for AVX-512 with VBMI: the tables of three channels fill twelve
// registers, and four runs are one.

namespace orbwatch::remap::avx512 {
namespace {

/// The table of one channel.
class PlaneTable {
 public:
  explicit PlaneTable(const std::array<std::uint8_t, 256>& plane) {
    for (std::size_t n = 0; n < 4; ++n) parts_[n] = _mm512_loadu_si512(&plane[64 * n]);
  }
  __m512i operator[](__m512i index) const {
    const __m512i lower = _mm512_permutex2var_epi8(parts_[0], index, parts_[1]);
    const __m512i upper = _mm512_permutex2var_epi8(parts_[2], index, parts_[3]);
    return _mm512_mask_blend_epi8(_mm512_movepi8_mask(index), lower, upper);
  }

 private:
  __m512i parts_[4];
};

/// Loads four runs.
inline __m512i indices_at(const std::uint8_t* first, std::ptrdiff_t stride) {
  if (stride == kRun) return _mm512_loadu_si512(first);
  const auto run = [&](int n) {
    return _mm_loadu_si128(reinterpret_cast<const __m128i*>(first + n * stride));
  };
  const __m256i lower = _mm256_inserti128_si256(_mm256_castsi128_si256(run(0)), run(1), 1);
  const __m256i upper = _mm256_inserti128_si256(_mm256_castsi128_si256(run(2)), run(3), 1);
  return _mm512_inserti64x4(_mm512_castsi256_si512(lower), upper, 1);
}

/// Implements Kernel::find_entries, two runs at a time; the last one may be alone.
inline void find_entries(const ValueScale& scale, const ImageView<const std::uint16_t>& values,
                         std::uint8_t* entries) {
  const auto each = [](std::uint16_t value) {
    return _mm512_set1_epi16(static_cast<std::int16_t>(value));
  };
  const __m512i low = each(scale.low), high = each(scale.high);
  // Loads in the parts that were written just before: larger ones would wait until those are in the
  // cache.
  const auto run = [&](int y) {
    const auto* const row = reinterpret_cast<const __m128i*>(values.row(y));
    return _mm256_inserti128_si256(_mm256_castsi128_si256(_mm_loadu_si128(row)),
                                   _mm_loadu_si128(row + 1), 1);
  };
  for (int y = 0; y < values.height; y += 2, entries += 2 * kRun) {
    const bool is_alone = y + 1 == values.height;
    const __m512i both =
        _mm512_inserti64x4(_mm512_castsi256_si512(run(y)), run(is_alone ? y : y + 1), 1);
    const __m512i above =
        _mm512_sub_epi16(_mm512_min_epu16(_mm512_max_epu16(both, low), high), low);
    const __m512i entry =
        _mm512_mulhi_epu16(_mm512_mullo_epi16(above, each(scale.unit)), each(scale.scale));
    const __m256i rounded = _mm512_cvtepi16_epi8(
        _mm512_srli_epi16(_mm512_add_epi16(entry, each(kHalfEntry)), kEntryBits));
    _mm_storeu_si128(reinterpret_cast<__m128i*>(entries), _mm256_castsi256_si128(rounded));
    if (is_alone) return;
    _mm_storeu_si128(reinterpret_cast<__m128i*>(entries + kRun),
                     _mm256_extracti128_si256(rounded, 1));
  }
}

/// Implements Kernel::look_up.
inline void look_up_colours(const ColourTable& table, const IndexRuns& runs,
                            const ImageView<std::uint8_t>& out) {
  constexpr int kRuns = 64 / kRun;
  const std::uint8_t* indices = runs.first;
  std::uint8_t* to = out.data;
  int rows = runs.rows;
  if (table.channels == 3) {
    const PlaneTable first(table.planes[0]), second(table.planes[1]), third(table.planes[2]);
    for (; rows >= kRuns; rows -= kRuns, indices += kRuns * runs.stride, to += kRuns * out.stride) {
      const __m512i index = indices_at(indices, runs.stride);
      store_threes(first[index], second[index], third[index], to, out.stride);
    }
  }
  for (; rows > 0; --rows, indices += runs.stride, to += out.stride) {
    table.look_up(indices, kRun, to);
  }
}

/// Stores the means of each two by two of four rows' samples, rounded.
inline void store_chroma(__m512i samples, std::uint8_t* upper, std::uint8_t* lower) {
  const __m512i pairs = _mm512_maddubs_epi16(samples, _mm512_set1_epi8(1));
  const __m512i other_rows = _mm512_shuffle_i32x4(pairs, pairs, _MM_SHUFFLE(2, 3, 0, 1));
  const __m512i sums = _mm512_add_epi16(_mm512_add_epi16(pairs, other_rows), _mm512_set1_epi16(2));
  const __m256i means = _mm512_cvtepi16_epi8(_mm512_srli_epi16(sums, 2));
  _mm_storel_epi64(reinterpret_cast<__m128i*>(upper), _mm256_castsi256_si128(means));
  _mm_storel_epi64(reinterpret_cast<__m128i*>(lower), _mm256_extracti128_si256(means, 1));
}

/// Implements Kernel::look_up_yuv420.
inline void look_up_yuv420(const ColourTable& table, const IndexRuns& runs,
                           const Yuv420Planes& out) {
  const PlaneTable luma(table.planes[0]), u(table.planes[1]), v(table.planes[2]);
  for (int y = 0; y < kTile; y += 4) {
    const __m512i index = indices_at(runs.first + y * runs.stride, runs.stride);
    const __m512i rows = luma[index];
    const auto row = [&](int n) { return reinterpret_cast<__m128i*>(out.y.row(y + n)); };
    _mm_storeu_si128(row(0), _mm512_castsi512_si128(rows));
    _mm_storeu_si128(row(1), _mm512_extracti32x4_epi32(rows, 1));
    _mm_storeu_si128(row(2), _mm512_extracti32x4_epi32(rows, 2));
    _mm_storeu_si128(row(3), _mm512_extracti32x4_epi32(rows, 3));
    store_chroma(u[index], out.u.row(y / 2), out.u.row(y / 2 + 1));
    store_chroma(v[index], out.v.row(y / 2), out.v.row(y / 2 + 1));
  }
}

}  // namespace
}  // namespace orbwatch::remap::avx512
