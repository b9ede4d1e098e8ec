#pragma once

#include <immintrin.h>

#include <cstddef>
#include <cstdint>
#include <cstring>

#include "proc/image/image_view.h"
#include "proc/remap/colour/colour_table.h"
#include "proc/remap/colour/run.h"
#include "proc/remap/kernel/interleave_avx512.h"

// How the kernel for AVX-512 with VBMI looks up colours: the tables of three channels fill twelve
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

/// Four runs.
inline __m512i indices_at(const std::uint8_t* first, std::ptrdiff_t stride) {
  if (stride == kRun) return _mm512_loadu_si512(first);
  const auto run = [&](int n) {
    return _mm_loadu_si128(reinterpret_cast<const __m128i*>(first + n * stride));
  };
  const __m256i lower = _mm256_inserti128_si256(_mm256_castsi128_si256(run(0)), run(1), 1);
  const __m256i upper = _mm256_inserti128_si256(_mm256_castsi128_si256(run(2)), run(3), 1);
  return _mm512_inserti64x4(_mm512_castsi256_si512(lower), upper, 1);
}

/// As Kernel::look_up.
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

}  // namespace
}  // namespace orbwatch::remap::avx512
