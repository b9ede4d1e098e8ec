// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstdint>
#include <cstring>

#include "proc/remap/colour/run.h"

#ifdef __aarch64__
#include <arm_neon.h>
#endif

/// A run of pixels as vectors, which compilers spread over the available registers: for loops that
/// compilers do not vectorize by themselves.
namespace orbwatch::remap {

using Bytes = std::uint8_t __attribute__((vector_size(kRun)));
using Words = std::uint16_t __attribute__((vector_size(2 * kRun)));
using Longs = std::uint32_t __attribute__((vector_size(4 * kRun)));

template <class Vector, class T>
[[gnu::always_inline]] inline Vector load(const T* from) {
  static_assert(sizeof(Vector) == kRun * sizeof(T));
  Vector vector;
  std::memcpy(&vector, from, sizeof vector);
  return vector;
}

[[gnu::always_inline]] inline void store(const Bytes& bytes, std::uint8_t* to) {
  std::memcpy(to, &bytes, sizeof bytes);
}

[[gnu::always_inline]] inline Words widened(const Bytes& bytes) {
  return __builtin_convertvector(bytes, Words);
}
[[gnu::always_inline]] inline Longs widened(const Words& words) {
  return __builtin_convertvector(words, Longs);
}
/// Keeps the low halves.
[[gnu::always_inline]] inline Bytes narrowed(const Words& words) {
  return __builtin_convertvector(words, Bytes);
}
[[gnu::always_inline]] inline Words narrowed(const Longs& longs) {
  return __builtin_convertvector(longs, Words);
}

/// Clamps each to [low, high], in two halves: compilers compare only vectors that fit a register.
[[gnu::always_inline]] inline Words clamped(const Words& words, std::uint16_t low,
                                            std::uint16_t high) {
  using Half = std::uint16_t __attribute__((vector_size(kRun)));
  std::array<Half, 2> halves;
  std::memcpy(halves.data(), &words, sizeof words);
  for (Half& half : halves) {
    half = half < low ? Half{} + low : half;
    half = half > high ? Half{} + high : half;
  }
  Words clamped;
  std::memcpy(&clamped, halves.data(), sizeof clamped);
  return clamped;
}

/// One byte per sample from one byte per pixel: part `part` of a run's samples.
template <int Channels>
[[gnu::always_inline]] inline Bytes spread(const Bytes& bytes, int part) {
  static_assert(Channels == 1 || Channels == 3);
  if constexpr (Channels == 1) {
    return bytes;
  } else {
    switch (part) {
      case 0:
        return __builtin_shufflevector(bytes, bytes, 0, 0, 0, 1, 1, 1, 2, 2, 2, 3, 3, 3, 4, 4, 4,
                                       5);
      case 1:
        return __builtin_shufflevector(bytes, bytes, 5, 5, 6, 6, 6, 7, 7, 7, 8, 8, 8, 9, 9, 9, 10,
                                       10);
      default:
        return __builtin_shufflevector(bytes, bytes, 10, 11, 11, 11, 12, 12, 12, 13, 13, 13, 14, 14,
                                       14, 15, 15, 15);
    }
  }
}

#ifdef __aarch64__
/// Divides each, up to 255 * 255, by 255 and rounds to nearest: instructions round sums and shifts.
[[gnu::always_inline]] inline Bytes rounded_255th(uint16x8_t low, uint16x8_t high) {
  const auto divided = vraddhn_u16(low, vrshrq_n_u16(low, 8));
  return reinterpret_cast<Bytes>(vraddhn_high_u16(divided, high, vrshrq_n_u16(high, 8)));
}
[[gnu::always_inline]] inline Bytes rounded_255th(const Words& words) {
  std::array<uint16x8_t, 2> halves;
  std::memcpy(halves.data(), &words, sizeof words);
  return rounded_255th(halves[0], halves[1]);
}
#else
/// Divides each, up to 255 * 255, by 255 and rounds to nearest.
[[gnu::always_inline]] inline Bytes rounded_255th(const Words& words) {
  const Words rounded = words + 128;
  return narrowed((rounded + (rounded >> 8)) >> 8);
}
#endif

/// True if all bits are zero.
[[gnu::always_inline]] inline bool is_zero(const Words& words) {
  using Half = std::uint64_t __attribute__((vector_size(kRun)));
  std::array<Half, 2> halves;
  std::memcpy(halves.data(), &words, sizeof words);
  const Half any = halves[0] | halves[1];
  return (any[0] | any[1]) == 0;
}

}  // namespace orbwatch::remap
