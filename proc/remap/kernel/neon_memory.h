// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <arm_neon.h>

#include <array>
#include <cstddef>
#include <cstdint>

#include "proc/remap/kernel/kernel_map.h"
#include "proc/remap/kernel/layout.h"

// Loading of windows and storing of blocks in the NEON kernel: in assembly for g++, which spills
// registers that lookups and interleaving stores need side by side; in intrinsics for clang.

namespace orbwatch::remap::neon {
namespace {

// ---- Loading a window ----

/// A register for each byte that a kernel writes per pixel.
template <Layout layout>
constexpr int kRegisters = info(layout).out_bytes();

/// A window's samples as tables for NEON's lookup, each for one sample of a pixel; for 16 bit
/// samples one for the lower bytes and one for the upper. A register has two rows of a table.
///
/// g++ needs two instructions to load a row and step to the next, and combines the four registers
/// of a table by way of the stack before every lookup.
template <Layout layout>
struct Tables {
  uint8x16x4_t a, b, c, d;  ///< one per sample

  /// Loads from the window's first sample on; `stride` in bytes.
  [[gnu::always_inline]] Tables(const std::uint8_t* at, std::ptrdiff_t stride);
};

#if !defined(__clang__)

// Operands %S, %T, %U and %V print the registers of a table, so `rows` fills one of them; x and y
// are one row each, de-interleaved by the load as far as possible.
#define ORBWATCH_LOAD_WINDOW(rows, ...) \
  asm(rows("S") rows("T") rows("U") rows("V") : __VA_ARGS__, [at] "+&r"(at) : [stride] "r"(stride))
#define ORBWATCH_LOAD(instruction, registers) instruction " {" registers "}, [%[at]], %[stride]\n\t"
#define ORBWATCH_COMBINE(instruction, to, x, y) instruction " " to ", " x ", " y "\n\t"

#define ORBWATCH_ROWS_ONE8(k) \
  ORBWATCH_LOAD("ld1", "%" k "[a].8b") "ld1 {%" k "[a].d}[1], [%[at]], %[stride]\n\t"
#define ORBWATCH_ROWS_FIRST_OF_TWO8(k) \
  ORBWATCH_LOAD("ld1", "%[x].16b")     \
  ORBWATCH_LOAD("ld1", "%[y].16b")     \
  ORBWATCH_COMBINE("uzp1", "%" k "[a].16b", "%[x].16b", "%[y].16b")
#define ORBWATCH_ROWS_TWO8(k)    \
  ORBWATCH_ROWS_FIRST_OF_TWO8(k) \
  ORBWATCH_COMBINE("uzp2", "%" k "[b].16b", "%[x].16b", "%[y].16b")
#define ORBWATCH_ROWS_ODD_OF_FOUR8(k)                                 \
  ORBWATCH_LOAD("ld2", "%S[x].16b, %T[x].16b")                        \
  ORBWATCH_LOAD("ld2", "%S[y].16b, %T[y].16b")                        \
  ORBWATCH_COMBINE("uzp1", "%" k "[a].16b", "%T[x].16b", "%T[y].16b") \
  ORBWATCH_COMBINE("uzp2", "%" k "[b].16b", "%T[x].16b", "%T[y].16b")
#define ORBWATCH_ROWS_THREE8(k)                                    \
  ORBWATCH_LOAD("ld3", "%S[x].8b, %T[x].8b, %U[x].8b")             \
  ORBWATCH_LOAD("ld3", "%S[y].8b, %T[y].8b, %U[y].8b")             \
  ORBWATCH_COMBINE("zip1", "%" k "[a].2d", "%S[x].2d", "%S[y].2d") \
  ORBWATCH_COMBINE("zip1", "%" k "[b].2d", "%T[x].2d", "%T[y].2d") \
  ORBWATCH_COMBINE("zip1", "%" k "[c].2d", "%U[x].2d", "%U[y].2d")
#define ORBWATCH_ROWS_FOUR8(k)                                     \
  ORBWATCH_LOAD("ld4", "%S[x].8b, %T[x].8b, %U[x].8b, %V[x].8b")   \
  ORBWATCH_LOAD("ld4", "%S[y].8b, %T[y].8b, %U[y].8b, %V[y].8b")   \
  ORBWATCH_COMBINE("zip1", "%" k "[a].2d", "%S[x].2d", "%S[y].2d") \
  ORBWATCH_COMBINE("zip1", "%" k "[b].2d", "%T[x].2d", "%T[y].2d") \
  ORBWATCH_COMBINE("zip1", "%" k "[c].2d", "%U[x].2d", "%U[y].2d") \
  ORBWATCH_COMBINE("zip1", "%" k "[d].2d", "%V[x].2d", "%V[y].2d")
#define ORBWATCH_WRITES(name) [name] "=&w"(name)

template <Layout layout>
inline Tables<layout>::Tables(const std::uint8_t* at, std::ptrdiff_t stride) {
  if constexpr (layout == Layout::One8) {
    ORBWATCH_LOAD_WINDOW(ORBWATCH_ROWS_ONE8, ORBWATCH_WRITES(a));
  } else if constexpr (layout == Layout::FirstOfTwo8) {
    uint8x16_t x, y;
    ORBWATCH_LOAD_WINDOW(ORBWATCH_ROWS_FIRST_OF_TWO8, ORBWATCH_WRITES(a), ORBWATCH_WRITES(x),
                         ORBWATCH_WRITES(y));
  } else if constexpr (layout == Layout::OddOfFour8) {
    uint8x16x2_t x, y;
    ORBWATCH_LOAD_WINDOW(ORBWATCH_ROWS_ODD_OF_FOUR8, ORBWATCH_WRITES(a), ORBWATCH_WRITES(b),
                         ORBWATCH_WRITES(x), ORBWATCH_WRITES(y));
  } else if constexpr (layout == Layout::Three8) {
    uint8x16x3_t x, y;
    ORBWATCH_LOAD_WINDOW(ORBWATCH_ROWS_THREE8, ORBWATCH_WRITES(a), ORBWATCH_WRITES(b),
                         ORBWATCH_WRITES(c), ORBWATCH_WRITES(x), ORBWATCH_WRITES(y));
  } else if constexpr (layout == Layout::Four8) {
    uint8x16x4_t x, y;
    ORBWATCH_LOAD_WINDOW(ORBWATCH_ROWS_FOUR8, ORBWATCH_WRITES(a), ORBWATCH_WRITES(b),
                         ORBWATCH_WRITES(c), ORBWATCH_WRITES(d), ORBWATCH_WRITES(x),
                         ORBWATCH_WRITES(y));
  } else {
    static_assert(layout == Layout::Two8 || layout == Layout::One16);
    uint8x16_t x, y;
    ORBWATCH_LOAD_WINDOW(ORBWATCH_ROWS_TWO8, ORBWATCH_WRITES(a), ORBWATCH_WRITES(b),
                         ORBWATCH_WRITES(x), ORBWATCH_WRITES(y));
  }
}

#undef ORBWATCH_WRITES
#undef ORBWATCH_ROWS_FOUR8
#undef ORBWATCH_ROWS_THREE8
#undef ORBWATCH_ROWS_ODD_OF_FOUR8
#undef ORBWATCH_ROWS_TWO8
#undef ORBWATCH_ROWS_FIRST_OF_TWO8
#undef ORBWATCH_ROWS_ONE8
#undef ORBWATCH_COMBINE
#undef ORBWATCH_LOAD
#undef ORBWATCH_LOAD_WINDOW

#else

template <Layout layout>
inline Tables<layout>::Tables(const std::uint8_t* at, std::ptrdiff_t stride) {
  for (int k = 0; k < 4; ++k, at += 2 * stride) {
    const std::uint8_t* const next = at + stride;
    if constexpr (layout == Layout::One8) {
      a.val[k] = vcombine_u8(vld1_u8(at), vld1_u8(next));
    } else if constexpr (layout == Layout::Three8) {
      const uint8x8x3_t x = vld3_u8(at), y = vld3_u8(next);
      a.val[k] = vcombine_u8(x.val[0], y.val[0]);
      b.val[k] = vcombine_u8(x.val[1], y.val[1]);
      c.val[k] = vcombine_u8(x.val[2], y.val[2]);
    } else if constexpr (layout == Layout::Four8) {
      const uint8x8x4_t x = vld4_u8(at), y = vld4_u8(next);
      a.val[k] = vcombine_u8(x.val[0], y.val[0]);
      b.val[k] = vcombine_u8(x.val[1], y.val[1]);
      c.val[k] = vcombine_u8(x.val[2], y.val[2]);
      d.val[k] = vcombine_u8(x.val[3], y.val[3]);
    } else {
      constexpr bool kOdd = layout == Layout::OddOfFour8;
      const uint8x16_t x = kOdd ? vld2q_u8(at).val[1] : vld1q_u8(at);
      const uint8x16_t y = kOdd ? vld2q_u8(next).val[1] : vld1q_u8(next);
      a.val[k] = vuzp1q_u8(x, y);
      if constexpr (layout != Layout::FirstOfTwo8) b.val[k] = vuzp2q_u8(x, y);
    }
  }
}

#endif

// ---- Storing blocks ----

/// The pixels of a block, row by row: a register for each 8 bit sample of a pixel; for 16 bit one
/// for rows 0 and 1, and one for 2 and 3.
template <Layout layout>
using Samples = std::array<uint8x16_t, kRegisters<layout>>;

/// Stores four rows of 8 bytes.
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

/// Stores a single block with one byte per pixel.
[[gnu::always_inline]] inline void store_blocks(
    const std::array<std::array<uint8x16_t, 1>, 1>& blocks, std::uint8_t* out,
    std::ptrdiff_t stride) {
  const uint32x4_t rows = vreinterpretq_u32_u8(blocks[0][0]);
  const auto at = [&](int row) { return reinterpret_cast<std::uint32_t*>(out + row * stride); };
  vst1q_lane_u32(at(0), rows, 0);
  vst1q_lane_u32(at(1), rows, 1);
  vst1q_lane_u32(at(2), rows, 2);
  vst1q_lane_u32(at(3), rows, 3);
}

/// Stores two adjacent blocks with one byte per pixel.
[[gnu::always_inline]] inline void store_blocks(
    const std::array<std::array<uint8x16_t, 1>, 2>& blocks, std::uint8_t* out,
    std::ptrdiff_t stride) {
  const uint32x4_t a = vreinterpretq_u32_u8(blocks[0][0]), b = vreinterpretq_u32_u8(blocks[1][0]);
  store_rows_of_8(vreinterpretq_u8_u32(vzip1q_u32(a, b)), vreinterpretq_u8_u32(vzip2q_u32(a, b)),
                  out, stride);
}

/// Stores four adjacent blocks with one byte per pixel: lane k of all is row k.
[[gnu::always_inline]] inline void store_blocks(
    const std::array<std::array<uint8x16_t, 1>, 4>& blocks, std::uint8_t* out,
    std::ptrdiff_t stride) {
#if !defined(__clang__)
  // g++ would combine the registers anew for each row.
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

/// Stores three bytes per pixel. Rows are stored with four bytes too many, into the place of the
/// next block; not for the last block.
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

/// Stores four bytes per pixel: a register becomes a row.
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

/// Stores a block with several bytes per pixel. `is_last`: it is the last in its row of blocks.
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

}  // namespace
}  // namespace orbwatch::remap::neon
