// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <arm_neon.h>

#include <array>
#include <cstddef>
#include <cstdint>

#include "proc/remap/kernel/kernel_map.h"
#include "proc/remap/kernel/neon_memory.h"

// Means of neighbouring pixels of four blocks side by side, in the NEON kernel. A register with one
// 8 bit sample of a block's pixels is four rows of four bytes.

namespace orbwatch::remap::neon {
namespace {

/// Pixels that are averaged: none, two in a row, two in a column, 2x2.
enum class Mean { None, AlongX, AlongY, OfFour };

/// Number of rows that remain of a block.
constexpr int rows_left(Mean mean) {
  return mean == Mean::None || mean == Mean::AlongX ? kBlock : kBlock / 2;
}

using FourBlocks = std::array<uint8x16_t, 4>;

/// Rows of one sample's means. AlongX: 0 and 1, 2 and 3, of 8 bytes each; AlongY: 0, 1, of 16
/// bytes; OfFour: 0 and 1 in the first register.
using MeanRows = std::array<uint8x16_t, 2>;

[[gnu::always_inline]] inline uint32x4_t rows_of(uint8x16_t block) {
  return vreinterpretq_u32_u8(block);
}

/// Rows 0 and 2 of two blocks, and rows 1 and 3.
[[gnu::always_inline]] inline uint8x16_t even_rows(uint8x16_t a, uint8x16_t b) {
  return vreinterpretq_u8_u32(vuzp1q_u32(rows_of(a), rows_of(b)));
}
[[gnu::always_inline]] inline uint8x16_t odd_rows(uint8x16_t a, uint8x16_t b) {
  return vreinterpretq_u8_u32(vuzp2q_u32(rows_of(a), rows_of(b)));
}

[[gnu::always_inline]] inline MeanRows means_along_x(const FourBlocks& blocks) {
  const auto means = [](uint8x16_t a, uint8x16_t b) {
    return vreinterpretq_u16_u8(vrhaddq_u8(vuzp1q_u8(a, b), vuzp2q_u8(a, b)));
  };
  const uint16x8_t left = means(blocks[0], blocks[1]), right = means(blocks[2], blocks[3]);
  const uint16x8_t even = vuzp1q_u16(left, right), odd = vuzp2q_u16(left, right);
  return {vreinterpretq_u8_u16(vuzp1q_u16(even, odd)), vreinterpretq_u8_u16(vuzp2q_u16(even, odd))};
}

[[gnu::always_inline]] inline MeanRows means_along_y(const FourBlocks& blocks) {
  const auto means = [](uint8x16_t a, uint8x16_t b) {
    return vrhaddq_u8(even_rows(a, b), odd_rows(a, b));
  };
  const uint8x16_t left = means(blocks[0], blocks[1]), right = means(blocks[2], blocks[3]);
  return {even_rows(left, right), odd_rows(left, right)};
}

[[gnu::always_inline]] inline MeanRows means_of_four(const FourBlocks& blocks) {
  const auto sums = [](uint8x16_t a, uint8x16_t b) {
    return vpadalq_u8(vpaddlq_u8(even_rows(a, b)), odd_rows(a, b));
  };
  const uint8x8_t left = vrshrn_n_u16(sums(blocks[0], blocks[1]), 2);
  const uint16x8_t all =
      vreinterpretq_u16_u8(vrshrn_high_n_u16(left, sums(blocks[2], blocks[3]), 2));
  const uint16x8_t rows = vuzp1q_u16(all, vextq_u16(all, all, 1));
  return {vreinterpretq_u8_u16(rows), vreinterpretq_u8_u16(rows)};
}

template <Mean mean>
[[gnu::always_inline]] inline MeanRows means_of(const FourBlocks& blocks) {
  if constexpr (mean == Mean::AlongX) return means_along_x(blocks);
  if constexpr (mean == Mean::AlongY) return means_along_y(blocks);
  return means_of_four(blocks);
}

/// Stores a row of pixels from the rows of their samples. Structures have names: clang's stores are
/// macros.
template <std::size_t samples>
[[gnu::always_inline]] inline void store_pixels(const std::array<uint8x8_t, samples>& row,
                                                std::uint8_t* out) {
  if constexpr (samples == 1) {
    vst1_u8(out, row[0]);
  } else if constexpr (samples == 2) {
    const uint8x8x2_t pixels{{row[0], row[1]}};
    vst2_u8(out, pixels);
  } else if constexpr (samples == 3) {
    const uint8x8x3_t pixels{{row[0], row[1], row[2]}};
    vst3_u8(out, pixels);
  } else {
    const uint8x8x4_t pixels{{row[0], row[1], row[2], row[3]}};
    vst4_u8(out, pixels);
  }
}
template <std::size_t samples>
[[gnu::always_inline]] inline void store_pixels(const std::array<uint8x16_t, samples>& row,
                                                std::uint8_t* out) {
  if constexpr (samples == 1) {
    vst1q_u8(out, row[0]);
  } else if constexpr (samples == 2) {
    const uint8x16x2_t pixels{{row[0], row[1]}};
    vst2q_u8(out, pixels);
  } else if constexpr (samples == 3) {
    const uint8x16x3_t pixels{{row[0], row[1], row[2]}};
    vst3q_u8(out, pixels);
  } else {
    const uint8x16x4_t pixels{{row[0], row[1], row[2], row[3]}};
    vst4q_u8(out, pixels);
  }
}

/// Stores the means of four blocks side by side.
template <Mean mean, std::size_t samples>
[[gnu::always_inline]] inline void store_means(
    const std::array<std::array<uint8x16_t, samples>, 4>& blocks, std::uint8_t* out,
    std::ptrdiff_t stride) {
  std::array<MeanRows, samples> means;
  for (std::size_t k = 0; k < samples; ++k) {
    means[k] = means_of<mean>({blocks[0][k], blocks[1][k], blocks[2][k], blocks[3][k]});
  }
  const auto row_of = [&means](const auto& part) {
    std::array<decltype(part(means[0])), samples> row;
    for (std::size_t k = 0; k < samples; ++k) row[k] = part(means[k]);
    return row;
  };
  const auto lower = [](std::size_t n) {
    return [n](const MeanRows& rows) { return vget_low_u8(rows[n]); };
  };
  const auto upper = [](std::size_t n) {
    return [n](const MeanRows& rows) { return vget_high_u8(rows[n]); };
  };
  if constexpr (mean == Mean::AlongY) {
    store_pixels(row_of([](const MeanRows& rows) { return rows[0]; }), out);
    store_pixels(row_of([](const MeanRows& rows) { return rows[1]; }), out + stride);
  } else {
    store_pixels(row_of(lower(0)), out);
    store_pixels(row_of(upper(0)), out + stride);
  }
  if constexpr (mean == Mean::AlongX) {
    store_pixels(row_of(lower(1)), out + 2 * stride);
    store_pixels(row_of(upper(1)), out + 3 * stride);
  }
}

}  // namespace
}  // namespace orbwatch::remap::neon
