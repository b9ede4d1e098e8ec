// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <immintrin.h>

#include <cstddef>
#include <cstdint>
#include <span>

#include "proc/image/image_view.h"
#include "proc/remap/kernel/corner_weights.h"
#include "proc/remap/kernel/interleave_avx2.h"
#include "proc/remap/kernel/mixed_tile.h"
#include "proc/remap/kernel/tile_mix.h"

// Mixing of tiles of two sources in three channels for AVX2, two rows at a
// time: like tile_mix.h, which mixes the others. Products of shares and samples
// are summed in pairs, samples less 128, because one factor is signed; the sum
// is then less by 255 * 128, and fits 16 bit.

namespace orbwatch::remap::avx2 {
namespace {

/// Order of pairs of shares for eight of a row's 48 samples, from eight pixels
/// of it.
struct alignas(16) PairOrder {
  std::int8_t at[16];

  constexpr PairOrder(int first_sample, int first_pixel) : at() {
    for (int k = 0; k < 16; ++k) {
      const int pixel = (first_sample + k / 2) / 3 - first_pixel;
      at[k] = static_cast<std::int8_t>(2 * pixel + k % 2);
    }
  }
};
constexpr PairOrder kPairOrders[3][2]{{PairOrder(0, 0), PairOrder(8, 0)},
                                      {PairOrder(16, 4), PairOrder(24, 4)},
                                      {PairOrder(32, 8), PairOrder(40, 8)}};

/// Shares of both sources for two rows, alternately, repeated for each sample
/// of the 96 bytes.
class PairShares {
 public:
  explicit PairShares(const CornerWeights& weights) : weights_(weights) {}

  /// The next two rows' shares for the samples of 32 bytes, number 0 to 2: for
  /// the first and for the last eight of each half.
  struct Part {
    __m256i first, last;
  };
  [[gnu::always_inline]] void take(Part (&parts)[3]) {
    const auto row = [&] {
      const __m256i of_row = reinterpret_cast<__m256i>(weights_.row);
      weights_.row += weights_.down;
      return _mm256_srli_epi16(of_row, 8);
    };
    const __m256i upper = row();
    const __m256i shares = joined_rows(upper, row());
    const __m256i others = _mm256_xor_si256(shares, _mm256_set1_epi8(-1));
    // Pixels 0 to 7, 4 to 11 and 8 to 15 of each row.
    const __m256i left = _mm256_unpacklo_epi8(shares, others);
    const __m256i right = _mm256_unpackhi_epi8(shares, others);
    const __m256i middle = _mm256_alignr_epi8(right, left, 8);
    parts[0] = repeated(_mm256_permute2x128_si256(left, middle, 0x20), 0, 1);
    parts[1] = repeated(_mm256_permute2x128_si256(right, left, 0x30), 2, 0);
    parts[2] = repeated(_mm256_permute2x128_si256(middle, right, 0x31), 1, 2);
  }

 private:
  /// `lower` and `upper`: which 16 bytes of a row the halves are shares of.
  [[gnu::always_inline]] static Part repeated(__m256i shares, int lower, int upper) {
    const auto order = [&](int part) {
      const auto at = [&](int n) {
        return _mm_load_si128(reinterpret_cast<const __m128i*>(kPairOrders[n][part].at));
      };
      return _mm256_inserti128_si256(_mm256_castsi128_si256(at(lower)), at(upper), 1);
    };
    return {_mm256_shuffle_epi8(shares, order(0)), _mm256_shuffle_epi8(shares, order(1))};
  }

  CornerWeights weights_;
};

/// The mean of 32 samples of two sources by their shares, rounded.
[[gnu::always_inline]] inline __m256i mean_of_pairs(const std::uint8_t* first,
                                                    const std::uint8_t* second,
                                                    const PairShares::Part& shares) {
  const auto less_128 = [](const std::uint8_t* from) {
    return _mm256_xor_si256(_mm256_loadu_si256(reinterpret_cast<const __m256i*>(from)),
                            _mm256_set1_epi8(-128));
  };
  // Adds 255 * 128 and 128, and divides by 255 like rounded_255th().
  const auto rounded = [](__m256i sum) {
    const __m256i whole = _mm256_xor_si256(sum, _mm256_set1_epi16(-0x8000));
    return _mm256_srli_epi16(_mm256_add_epi16(whole, _mm256_srli_epi16(whole, 8)), 8);
  };
  const __m256i a = less_128(first), b = less_128(second);
  return _mm256_packus_epi16(
      rounded(_mm256_maddubs_epi16(shares.first, _mm256_unpacklo_epi8(a, b))),
      rounded(_mm256_maddubs_epi16(shares.last, _mm256_unpackhi_epi8(a, b))));
}

inline void mix_two_colours(std::span<const MixedTile> tiles, const ImageView<std::uint8_t>& out) {
  constexpr int kPart = 32, kRowBytes = 3 * kRun;
  PairShares shares{CornerWeights(shared_corners<2>(tiles)[0])};
  const std::uint8_t *first = tiles[0].samples, *second = tiles[1].samples;
  std::uint8_t* to = out.data;
  for (int y = 0; y < kTile; y += 2, to += 2 * out.stride) {
    PairShares::Part of[3];
    shares.take(of);
    const __m256i left = mean_of_pairs(first, second, of[0]);
    const __m256i middle = mean_of_pairs(first + kPart, second + kPart, of[1]);
    const __m256i right = mean_of_pairs(first + 2 * kPart, second + 2 * kPart, of[2]);
    _mm256_storeu_si256(reinterpret_cast<__m256i*>(to), left);
    _mm_storeu_si128(reinterpret_cast<__m128i*>(to + kPart), _mm256_castsi256_si128(middle));
    std::uint8_t* const below = to + out.stride;
    _mm_storeu_si128(reinterpret_cast<__m128i*>(below), _mm256_extracti128_si256(middle, 1));
    _mm256_storeu_si256(reinterpret_cast<__m256i*>(below + kRun), right);
    first += 2 * kRowBytes;
    second += 2 * kRowBytes;
  }
}

/// Implements Kernel::mix.
inline void mix_pairs(std::span<const MixedTile> tiles, const ImageView<std::uint8_t>& out) {
  tiles.size() == 2 && out.channels == 3 ? mix_two_colours(tiles, out) : mix_tiles(tiles, out);
}

}  // namespace
}  // namespace orbwatch::remap::avx2
