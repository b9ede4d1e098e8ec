#pragma once

#include <arm_neon.h>

#include <array>
#include <cstddef>
#include <cstdint>

#include "proc/remap/block_map.h"
#include "proc/remap/neon_tables.h"

namespace orbwatch::remap {

/// What a block's pixels become, row by row: a register for each 8 bit sample of a pixel; of 16 bit
/// one for rows 0 and 1, and one for 2 and 3.
template <Layout layout>
using Samples = std::array<uint8x16_t, kRegisters<layout>>;

/// Four rows of 8 bytes.
[[gnu::always_inline]] inline void store_rows_of_8(uint8x16_t upper, uint8x16_t lower,
                                                   std::uint8_t* out, std::ptrdiff_t stride) {
  const auto store_second = [](std::uint8_t* to, uint8x16_t rows) {
    vst1q_lane_u64(reinterpret_cast<std::uint64_t*>(to), vreinterpretq_u64_u8(rows), 1);
  };
  vst1_u8(out, vget_low_u8(upper));
  store_second(out + stride, upper);
  vst1_u8(out + 2 * stride, vget_low_u8(lower));
  store_second(out + 3 * stride, lower);
}

/// Two blocks side by side of one byte per pixel.
[[gnu::always_inline]] inline void store_blocks(
    const std::array<std::array<uint8x16_t, 1>, 2>& blocks, std::uint8_t* out,
    std::ptrdiff_t stride) {
  const uint32x4_t a = vreinterpretq_u32_u8(blocks[0][0]), b = vreinterpretq_u32_u8(blocks[1][0]);
  store_rows_of_8(vreinterpretq_u8_u32(vzip1q_u32(a, b)), vreinterpretq_u8_u32(vzip2q_u32(a, b)),
                  out, stride);
}

/// Four blocks side by side of one byte per pixel: lane k of all is row k.
[[gnu::always_inline]] inline void store_blocks(
    const std::array<std::array<uint8x16_t, 1>, 4>& blocks, std::uint8_t* out,
    std::ptrdiff_t stride) {
#if !defined(__clang__)
  // g++ would bring the registers together anew for each row.
  const uint8x16x4_t all{blocks[0][0], blocks[1][0], blocks[2][0], blocks[3][0]};
  asm volatile(
      "st4 {%S1.s, %T1.s, %U1.s, %V1.s}[0], [%0], %2\n\t"
      "st4 {%S1.s, %T1.s, %U1.s, %V1.s}[1], [%0], %2\n\t"
      "st4 {%S1.s, %T1.s, %U1.s, %V1.s}[2], [%0], %2\n\t"
      "st4 {%S1.s, %T1.s, %U1.s, %V1.s}[3], [%0], %2"
      : "+&r"(out)
      : "w"(all), "r"(stride)
      : "memory");
#else
  const uint32x4x4_t all{vreinterpretq_u32_u8(blocks[0][0]), vreinterpretq_u32_u8(blocks[1][0]),
                         vreinterpretq_u32_u8(blocks[2][0]), vreinterpretq_u32_u8(blocks[3][0])};
  const auto at = [&](int row) { return reinterpret_cast<std::uint32_t*>(out + row * stride); };
  vst4q_lane_u32(at(0), all, 0);
  vst4q_lane_u32(at(1), all, 1);
  vst4q_lane_u32(at(2), all, 2);
  vst4q_lane_u32(at(3), all, 3);
#endif
}

/// Three bytes per pixel. Rows are stored with four bytes too many, where the next block goes; but
/// not of the last block.
template <bool is_last>
[[gnu::always_inline]] inline void store_threes(const uint8x16x3_t& samples, std::uint8_t* out,
                                                std::ptrdiff_t stride) {
  static constexpr std::array<std::uint8_t, 16> kFirstRow{0,  16, 32, 1,  17, 33, 2, 18,
                                                          34, 3,  19, 35, 0,  0,  0, 0};
  uint8x16_t index = vld1q_u8(kFirstRow.data());
  for (int row = 0; row < kBlock; ++row, out += stride) {
    const uint8x16_t pixels = vqtbl3q_u8(samples, index);
    index = vaddq_u8(index, vdupq_n_u8(kBlock));
    if constexpr (is_last) {
      vst1_u8(out, vget_low_u8(pixels));
      vst1q_lane_u32(reinterpret_cast<std::uint32_t*>(out + 8), vreinterpretq_u32_u8(pixels), 2);
    } else {
      vst1q_u8(out, pixels);
    }
  }
}

/// Four bytes per pixel: a register becomes a row.
[[gnu::always_inline]] inline void store_fours(const std::array<uint8x16_t, 4>& samples,
                                               std::uint8_t* out, std::ptrdiff_t stride) {
  const auto store_two = [&](uint8x16_t first, uint8x16_t second) {
    const uint16x8_t a = vreinterpretq_u16_u8(first), b = vreinterpretq_u16_u8(second);
    vst1q_u8(out, vreinterpretq_u8_u16(vzip1q_u16(a, b)));
    vst1q_u8(out + stride, vreinterpretq_u8_u16(vzip2q_u16(a, b)));
    out += 2 * stride;
  };
  store_two(vzip1q_u8(samples[0], samples[1]), vzip1q_u8(samples[2], samples[3]));
  store_two(vzip2q_u8(samples[0], samples[1]), vzip2q_u8(samples[2], samples[3]));
}

/// A block of several bytes per pixel. `is_last`: in its row of blocks.
template <Layout layout, bool is_last>
[[gnu::always_inline]] inline void store_block(const Samples<layout>& samples, std::uint8_t* out,
                                               std::ptrdiff_t stride) {
  if constexpr (layout == Layout::One16) {
    store_rows_of_8(samples[0], samples[1], out, stride);
  } else if constexpr (kRegisters<layout> == 2) {
    store_rows_of_8(vzip1q_u8(samples[0], samples[1]), vzip2q_u8(samples[0], samples[1]), out,
                    stride);
  } else if constexpr (kRegisters<layout> == 3) {
    store_threes<is_last>({samples[0], samples[1], samples[2]}, out, stride);
  } else {
    store_fours(samples, out, stride);
  }
}

}  // namespace orbwatch::remap
