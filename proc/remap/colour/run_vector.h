#pragma once

#include <array>
#include <cstdint>
#include <cstring>

#include "proc/remap/grid/coordinate.h"

/// So many pixels side by side as vectors, which compilers spread over the registers that there
/// are: for loops whose arithmetic they do not make vector code of by themselves.
namespace orbwatch::remap {

inline constexpr int kRunPixels = kTile;

using Bytes = std::uint8_t __attribute__((vector_size(kRunPixels)));
using Words = std::uint16_t __attribute__((vector_size(2 * kRunPixels)));
using Longs = std::uint32_t __attribute__((vector_size(4 * kRunPixels)));

template <class Vector, class T>
[[gnu::always_inline]] inline Vector load(const T* from) {
  static_assert(sizeof(Vector) == kRunPixels * sizeof(T));
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
/// The low halves.
[[gnu::always_inline]] inline Bytes narrowed(const Words& words) {
  return __builtin_convertvector(words, Bytes);
}
[[gnu::always_inline]] inline Words narrowed(const Longs& longs) {
  return __builtin_convertvector(longs, Words);
}

/// Each within [low, high]. By halves: compilers compare only vectors that fit a register.
[[gnu::always_inline]] inline Words clamped(const Words& words, std::uint16_t low,
                                            std::uint16_t high) {
  using Half = std::uint16_t __attribute__((vector_size(kRunPixels)));
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

/// Whether all bits are zero.
[[gnu::always_inline]] inline bool is_zero(const Words& words) {
  using Half = std::uint64_t __attribute__((vector_size(kRunPixels)));
  std::array<Half, 2> halves;
  std::memcpy(halves.data(), &words, sizeof words);
  const Half any = halves[0] | halves[1];
  return (any[0] | any[1]) == 0;
}

}  // namespace orbwatch::remap
