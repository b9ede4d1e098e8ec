// SPDX-License-Identifier: Apache-2.0
#include "proc/signals/hot_spot/edges.h"

#include <array>
#include <bit>
#include <cstddef>
#include <cstring>

namespace orbwatch::signals {
namespace {

constexpr int kVector = 16;
constexpr std::size_t kVectors = 4;  // vectors per block

using Bytes = std::uint8_t __attribute__((vector_size(kVector)));
using Words = std::uint16_t __attribute__((vector_size(kVector)));
using Block = std::array<Bytes, kVectors>;

template <class Vector, class T>
[[gnu::always_inline]] inline Vector load(const T* from) {
  Vector vector;
  std::memcpy(&vector, from, sizeof vector);
  return vector;
}

/// The bytes of both at even places; odds(): at odd ones.
[[gnu::always_inline]] inline Bytes evens(const Bytes& a, const Bytes& b) {
  return __builtin_shufflevector(a, b, 0, 2, 4, 6, 8, 10, 12, 14, 16, 18, 20, 22, 24, 26, 28, 30);
}
[[gnu::always_inline]] inline Bytes odds(const Bytes& a, const Bytes& b) {
  return __builtin_shufflevector(a, b, 1, 3, 5, 7, 9, 11, 13, 15, 17, 19, 21, 23, 25, 27, 29, 31);
}

/// Sets all bits of a pixel's byte if it is at or above `least`.
[[gnu::always_inline]] inline Bytes at_least(const std::uint8_t* values, std::uint8_t least) {
  return Bytes(load<Bytes>(values) >= Bytes{} + least);
}
[[gnu::always_inline]] inline Bytes at_least(const std::uint16_t* values, std::uint16_t least) {
  return evens(Bytes(load<Words>(values) >= Words{} + least),
               Bytes(load<Words>(values + kVector / 2) >= Words{} + least));
}

template <class T>
[[gnu::always_inline]] inline Block hot_block(const T* values, T least) {
  return {at_least(values, least), at_least(values + kVector, least),
          at_least(values + 2 * kVector, least), at_least(values + 3 * kVector, least)};
}

[[gnu::always_inline]] inline bool is_cold(const Block& hot) {
  using Halves = std::uint64_t __attribute__((vector_size(kVector)));
  const auto halves = Halves(hot[0] | hot[1] | hot[2] | hot[3]);
  return (halves[0] | halves[1]) == 0;
}

/// A bit for each pixel that is hot and seen, the first pixel's is the lowest.
[[gnu::always_inline]] inline std::uint64_t bits_of(const Block& hot,
                                                    const std::uint8_t* validity) {
  constexpr auto kSeen = static_cast<std::uint8_t>(Validity::Seen);
  const auto weighted = [&](std::size_t i) {
    const auto seen = Bytes(load<Bytes>(validity + i * kVector) == Bytes{} + kSeen);
    return hot[i] & seen & Bytes{1, 2, 4, 8, 16, 32, 64, 128, 1, 2, 4, 8, 16, 32, 64, 128};
  };
  const auto halved = [](const Bytes& a, const Bytes& b) { return evens(a, b) + odds(a, b); };
  Bytes sums = halved(halved(weighted(0), weighted(1)), halved(weighted(2), weighted(3)));
  sums = halved(sums, sums);
  return load<std::uint64_t>(&sums);
}

/// Writes the edges of runs, block by block.
struct EdgeWriter {
  int* edges;
  std::uint64_t is_inside = 0;  ///< 1: the previous pixel belongs to a run

  /// `bits`: those of bits_of(), for the block at `x`.
  [[gnu::always_inline]] void add(std::uint64_t bits, int x) {
    std::uint64_t changes = bits ^ (bits << 1 | is_inside);
    is_inside = bits >> 63;
    for (; changes != 0; changes &= changes - 1) *edges++ = x + std::countr_zero(changes);
  }
  [[gnu::always_inline]] void end(int x) {
    if (is_inside != 0) *edges++ = x;
    is_inside = 0;
  }
};

}  // namespace

template <class T>
int* EdgeFinder::find_by_blocks(const T* values, const std::uint8_t* validity, const Span& span,
                                T least, int* edges) {
  static_assert(kBlock == kVector * kVectors);
  EdgeWriter writer{edges};
  int x = span.begin;
  for (; x + kBlock <= span.end; x += kBlock) {
    const Block hot = hot_block(values + x, least);
    if (is_cold(hot)) {
      writer.end(x);
    } else {
      writer.add(bits_of(hot, validity + x), x);
    }
  }
  if (x < span.end) {  // the last block again, without the pixels already processed
    const int last = span.end - kBlock;
    const std::uint64_t bits = bits_of(hot_block(values + last, least), validity + last);
    writer.add(bits >> (x - last), x);
  }
  writer.end(span.end);
  return writer.edges;
}

template int* EdgeFinder::find_by_blocks(const std::uint8_t*, const std::uint8_t*, const Span&,
                                         std::uint8_t, int*);
template int* EdgeFinder::find_by_blocks(const std::uint16_t*, const std::uint8_t*, const Span&,
                                         std::uint16_t, int*);

}  // namespace orbwatch::signals
