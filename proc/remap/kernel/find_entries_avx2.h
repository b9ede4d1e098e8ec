// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <immintrin.h>

#include <cstddef>
#include <cstdint>

#include "proc/image/image_view.h"
#include "proc/remap/colour/colour_table.h"
#include "proc/remap/kernel/interleave_avx2.h"

namespace orbwatch::remap::avx2 {
namespace {

/// Implements Kernel::find_entries, two runs at a time; the last one may be alone.
inline void find_entries(const ValueScale& scale, const ImageView<const std::uint16_t>& values,
                         std::uint8_t* entries) {
  const auto each = [](std::uint16_t value) {
    return _mm256_set1_epi16(static_cast<std::int16_t>(value));
  };
  const __m256i low = each(scale.low), high = each(scale.high);
  const __m256i unit = each(scale.unit), per_unit = each(scale.scale), half = each(kHalfEntry);
  const auto entries_of = [&](int y) {
    const auto* const from = reinterpret_cast<const __m256i*>(values.row(y));
    const __m256i within = _mm256_min_epu16(_mm256_max_epu16(_mm256_loadu_si256(from), low), high);
    const __m256i above = _mm256_sub_epi16(within, low);
    const __m256i entry = _mm256_mulhi_epu16(_mm256_mullo_epi16(above, unit), per_unit);
    return _mm256_srli_epi16(_mm256_add_epi16(entry, half), kEntryBits);
  };
  for (int y = 0; y < values.height; y += 2, entries += 2 * kRun) {
    const bool is_alone = y + 1 == values.height;
    const __m256i first = entries_of(y);
    const __m256i rows = joined_rows(first, is_alone ? first : entries_of(y + 1));
    if (is_alone) {
      return _mm_storeu_si128(reinterpret_cast<__m128i*>(entries), _mm256_castsi256_si128(rows));
    }
    _mm256_storeu_si256(reinterpret_cast<__m256i*>(entries), rows);
  }
}

}  // namespace
}  // namespace orbwatch::remap::avx2
