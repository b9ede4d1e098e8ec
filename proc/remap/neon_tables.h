#pragma once

#include <arm_neon.h>

#include <cstddef>
#include <cstdint>

#include "proc/remap/kernel.h"

namespace orbwatch::remap {

/// A register for each byte that a kernel writes per pixel.
template <Layout layout>
inline constexpr int kRegisters = info(layout).out_bytes();

/// A window's samples as tables for NEON's lookup, each for one sample of a pixel; of 16 bit
/// samples one for the lower bytes and one for the upper. A register has two rows of a table.
///
/// In assembly for g++, which needs two instructions to load a row and step to the next, and brings
/// the four registers of a table together by way of the stack before every lookup.
template <Layout layout>
struct Tables {
  uint8x16x4_t a, b, c, d;  ///< as many as there are samples

  /// From the window's first sample on; `stride` in bytes.
  [[gnu::always_inline]] Tables(const std::uint8_t* at, std::ptrdiff_t stride);
};

#if !defined(__clang__)

// %S, %T, %U and %V print the registers of a table, so `rows` is what fills one of them; x and y
// are one row each, taken apart by the load as far as it can.
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

}  // namespace orbwatch::remap
