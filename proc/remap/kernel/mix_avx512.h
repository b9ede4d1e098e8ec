// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <immintrin.h>

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>

#include "proc/image/image_view.h"
#include "proc/remap/kernel/corner_weights.h"
#include "proc/remap/kernel/interleave_avx512.h"
#include "proc/remap/kernel/mixed_tile.h"

// Tile mixing of the kernel for AVX-512: like tile_mix.h, four rows at a time.

namespace orbwatch::remap::avx512 {
namespace {

/// CornerWeights of four rows.
class FourRows {
 public:
  FourRows() = default;
  explicit FourRows(CornerWeights weights) {
    const auto take_two = [&] {
      const Words first = weights.row, second = first + weights.down;
      weights.row = second + weights.down;
      return _mm512_inserti64x4(_mm512_castsi256_si512(reinterpret_cast<__m256i>(first)),
                                reinterpret_cast<__m256i>(second), 1);
    };
    upper_ = take_two();
    lower_ = take_two();
    const Words four = weights.down * 4;
    down_ = _mm512_broadcast_i64x4(reinterpret_cast<__m256i>(four));
  }

  __m512i take() {
    const auto bytes = [](__m512i rows) {
      return _mm512_cvtepi16_epi8(_mm512_srli_epi16(rows, 8));
    };
    const __m512i weights =
        _mm512_inserti64x4(_mm512_castsi256_si512(bytes(upper_)), bytes(lower_), 1);
    upper_ = _mm512_add_epi16(upper_, down_);
    lower_ = _mm512_add_epi16(lower_, down_);
    return weights;
  }

 private:
  __m512i upper_, lower_, down_;
};

/// Sums of 64 products of bytes; each half of a 128 bit lane separately.
struct Products64 {
  __m512i low = _mm512_setzero_si512(), high = _mm512_setzero_si512();

  void add(__m512i a, __m512i b) {
    const __m512i zero = _mm512_setzero_si512();
    low = _mm512_add_epi16(
        low, _mm512_mullo_epi16(_mm512_unpacklo_epi8(a, zero), _mm512_unpacklo_epi8(b, zero)));
    high = _mm512_add_epi16(
        high, _mm512_mullo_epi16(_mm512_unpackhi_epi8(a, zero), _mm512_unpackhi_epi8(b, zero)));
  }
  /// Implements rounded_255th().
  __m512i rounded_255th() const {
    const auto rounded = [](__m512i sum) {
      const __m512i more = _mm512_add_epi16(sum, _mm512_set1_epi16(128));
      return _mm512_srli_epi16(_mm512_add_epi16(more, _mm512_srli_epi16(more, 8)), 8);
    };
    return _mm512_packus_epi16(rounded(low), rounded(high));
  }
};

/// Weights repeated for each sample of part `part` of 64 pixels.
template <int Channels>
__m512i spread64(__m512i weights, int part) {
  if constexpr (Channels == 1) return weights;
  return _mm512_permutexvar_epi8(_mm512_load_si512(kThreesOrder[part].third), weights);
}

/// Stores sixteen bytes at their place in rows of kRun * Channels.
template <int Channels, int lane>
void store_lane(__m512i samples, int part, std::uint8_t* out, std::ptrdiff_t stride) {
  const int place = 4 * part + lane;
  _mm_storeu_si128(
      reinterpret_cast<__m128i*>(out + place / Channels * stride + place % Channels * kRun),
      _mm512_extracti32x4_epi32(samples, lane));
}

template <int Channels, std::size_t Count>
void mix_so_many(std::span<const MixedTile> tiles, const ImageView<std::uint8_t>& out) {
  std::array<FourRows, Count - 1> shared;  // sums over the first sources
  const auto corners = shared_corners<Count>(tiles);
  for (std::size_t n = 0; n + 1 < Count; ++n) shared[n] = FourRows(CornerWeights(corners[n]));
  std::uint8_t* to = out.data;
  for (int y = 0; y < kTile; y += 4, to += 4 * out.stride) {
    std::array<Products64, Channels> means;
    __m512i before = _mm512_setzero_si512();
    for (std::size_t n = 0; n < Count; ++n) {
      const __m512i until = n + 1 < Count ? shared[n].take() : _mm512_set1_epi8(-1);
      const __m512i weights = _mm512_sub_epi8(until, before);
      before = until;
      for (int part = 0; part < Channels; ++part) {
        means[part].add(_mm512_loadu_si512(tiles[n].samples + Channels * kRun * y + 64 * part),
                        spread64<Channels>(weights, part));
      }
    }
    for (int part = 0; part < Channels; ++part) {
      const __m512i samples = means[part].rounded_255th();
      store_lane<Channels, 0>(samples, part, to, out.stride);
      store_lane<Channels, 1>(samples, part, to, out.stride);
      store_lane<Channels, 2>(samples, part, to, out.stride);
      store_lane<Channels, 3>(samples, part, to, out.stride);
    }
  }
}

/// Implements Kernel::mix.
inline void mix_tiles(std::span<const MixedTile> tiles, const ImageView<std::uint8_t>& out) {
  with_constants(out.channels, tiles.size(), [&]<int Channels, std::size_t Count>() {
    mix_so_many<Channels, Count>(tiles, out);
  });
}

}  // namespace
}  // namespace orbwatch::remap::avx512
