// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <type_traits>
#include <utility>

#include "proc/remap/kernel/bilinear.h"
#include "proc/remap/kernel/kernel.h"

// Pixel-by-pixel sampling of vector kernels, where a map is too steep or curved for windows: in
// loops over runs of pixels that compilers vectorize; only the source is read pixel by pixel.
//
// Included by each kernel and compiled for its instruction set. The unnamed namespace gives each
// its own copy, which the linker cannot exchange; for the same reason no library function is
// called.

namespace orbwatch::remap {
namespace {

/// The clamp of coordinates to the plane, so that each has four neighbours.
template <Layout layout>
struct PointLimits {
  std::int32_t last_u, last_v;  ///< Q13
  std::int32_t most_u, most_v;  ///< limit of the upper left neighbour

  [[gnu::always_inline]] explicit PointLimits(const SourcePlane& source)
      : last_u((source.width - 1) << kFractionBits),
        last_v(((source.height - 1) << kFractionBits) - kShortOfLastRow<layout>),
        most_u(source.width - 2),
        most_v(source.height - 2) {}
};

/// A run of pixels: byte offsets of their upper left neighbours from the plane's first pixel, and
/// the distances from those, Q13: up to one, inclusive.
struct PointRun {
  std::int32_t offset[kPointRun];
  std::uint16_t across[kPointRun], down[kPointRun];

  template <Layout layout>
  [[gnu::always_inline]] void place(const std::int32_t* at_u, const std::int32_t* at_v,
                                    const PointLimits<layout>& limits, std::int32_t stride) {
    constexpr std::int32_t kAddedU = added_u(layout), kAddedV = added_v(layout);
    constexpr std::int32_t kPixelBytes = info(layout).pixel_bytes;
    const auto least = [](std::int32_t a, std::int32_t b) { return a < b ? a : b; };
    const auto held = [&](std::int32_t c, std::int32_t last) { return least(c < 0 ? 0 : c, last); };
    for (int x = 0; x < kPointRun; ++x) {
      const std::int32_t held_u = held(at_u[x] + kAddedU, limits.last_u);
      const std::int32_t held_v = held(at_v[x] + kAddedV, limits.last_v);
      const std::int32_t u = least(held_u >> kFractionBits, limits.most_u);
      const std::int32_t v = least(held_v >> kFractionBits, limits.most_v);
      offset[x] = v * stride + u * kPixelBytes;
      across[x] = static_cast<std::uint16_t>(held_u - (u << kFractionBits));
      down[x] = static_cast<std::uint16_t>(held_v - (v << kFractionBits));
    }
    // Written as vectors and read back one by one: else the compiler extracts the offsets from the
    // vectors, which takes longer.
    asm volatile("" : : : "memory");
  }
};

/// Samples of two neighbours in a row, from the first one on in memory order: all that the layout
/// uses of a pixel, or one of them, if a word does not hold all.
template <Layout layout>
struct NeighbourPair {
  static constexpr LayoutInfo kInfo = info(layout);
  static constexpr int bytes_of(int samples) {
    return kInfo.pixel_bytes + ((samples - 1) * kInfo.every + 1) * kInfo.sample_bytes;
  }
  static constexpr int kSamples = bytes_of(kInfo.samples) <= 8 ? kInfo.samples : 1;
  static constexpr int kBytes = bytes_of(kSamples);
  using Word = std::conditional_t<kBytes <= 2, std::uint16_t,
                                  std::conditional_t<kBytes <= 4, std::uint32_t, std::uint64_t>>;
  using Sample = std::conditional_t<kInfo.sample_bytes == 1, std::uint8_t, std::uint16_t>;
};

#ifdef __x86_64__
constexpr bool kReadsQuads = true;
#else
constexpr bool kReadsQuads = false;
#endif

/// The neighbours of a run, above and below.
template <Layout layout>
struct PointNeighbours {
  using Pair = NeighbourPair<layout>;
  typename Pair::Word upper[kPointRun], lower[kPointRun];

  /// Reads four words at a time: x86 stalls on a vector read of words that were written separately
  /// just before. The rows alternate, so that no offset waits in a register for the second.
  [[gnu::always_inline]] void read_quads(const PointRun& run, const std::uint8_t* upper_row,
                                         const std::uint8_t* lower_row) {
    using Quads = std::uint64_t __attribute__((vector_size(2 * kPointRun)));
    Quads above, below;
#pragma GCC unroll 4
    for (int x = 0; x < kPointRun; x += 4) {
      std::uint64_t up = 0, low = 0;
#pragma GCC unroll 4
      for (int k = 0; k < 4; ++k) {
        const std::ptrdiff_t from = run.offset[x + k];
        std::uint16_t value;
        std::memcpy(&value, upper_row + from, sizeof value);
        up |= std::uint64_t{value} << 16 * k;
        std::memcpy(&value, lower_row + from, sizeof value);
        low |= std::uint64_t{value} << 16 * k;
      }
      above[x / 4] = up;
      below[x / 4] = low;
    }
    std::memcpy(upper, &above, sizeof above);
    std::memcpy(lower, &below, sizeof below);
  }

  /// Reads from sample `first` of each pixel on.
  [[gnu::always_inline]] void read(const PointRun& run, const SourcePlane& source, int first) {
    constexpr LayoutInfo kInfo = Pair::kInfo;
    const std::uint8_t* const upper_row =
        source.data + (kInfo.first + first * kInfo.every) * kInfo.sample_bytes;
    const std::uint8_t* const lower_row = upper_row + source.stride;
    if constexpr (kReadsQuads && sizeof(typename Pair::Word) == 2) {
      return read_quads(run, upper_row, lower_row);
    }
#pragma GCC unroll 16
    for (int x = 0; x < kPointRun; ++x) {
      const std::ptrdiff_t from = run.offset[x];
      upper[x] = lower[x] = 0;
      std::memcpy(&upper[x], upper_row + from, Pair::kBytes);
      std::memcpy(&lower[x], lower_row + from, Pair::kBytes);
    }
  }
};

/// Interpolates sample `k` of those that were read, for a run: see interpolate8() and
/// interpolate16().
template <int k, Layout layout>
[[gnu::always_inline]] inline void interpolate_run(const PointRun& run,
                                                   const PointNeighbours<layout>& from,
                                                   typename NeighbourPair<layout>::Sample* out) {
  using Sample = typename NeighbourPair<layout>::Sample;
  constexpr LayoutInfo kInfo = info(layout);
  constexpr int kLeft = 8 * k * kInfo.every * kInfo.sample_bytes;
  constexpr int kRight = kLeft + 8 * kInfo.pixel_bytes;
  constexpr int kWeightShift = kFractionBits - kWeightBits;
  for (int x = 0; x < kPointRun; ++x) {
    const auto a = static_cast<Sample>(from.upper[x] >> kLeft);
    const auto b = static_cast<Sample>(from.upper[x] >> kRight);
    const auto c = static_cast<Sample>(from.lower[x] >> kLeft);
    const auto d = static_cast<Sample>(from.lower[x] >> kRight);
    if constexpr (sizeof(Sample) == 1) {
      const auto u = static_cast<std::uint16_t>(run.across[x] >> kWeightShift);
      const auto rest = static_cast<std::uint16_t>(kUnitWeight - u);
      const auto v = static_cast<std::int16_t>((run.down[x] << (16 - kFractionBits)) - (1 << 15));
      const auto top = static_cast<std::uint16_t>(a * rest + b * u);
      const auto bottom = static_cast<std::uint16_t>(c * rest + d * u);
      const auto difference = static_cast<std::int16_t>(bottom - top);
      // The result of pmulhrsw.
      const auto shifted = static_cast<std::int16_t>((((difference * v) >> 14) + 1) >> 1);
      const auto twice = static_cast<std::uint16_t>(top + bottom + shifted + kUnitWeight);
      out[x] = static_cast<Sample>(twice >> (kWeightBits + 1));
    } else {
      const std::uint32_t u = run.across[x] >> kWeightShift, v = run.down[x] >> kWeightShift;
      const std::uint32_t left = kUnitWeight - u, above = kUnitWeight - v;
      const std::uint32_t sum = (a * left + b * u) * above + (c * left + d * u) * v;
      out[x] = static_cast<Sample>((sum + kUnitWeight * kUnitWeight / 2) >> (2 * kWeightBits));
    }
  }
}

/// Samples a run: all samples of its pixels, without gaps.
template <Layout layout>
[[gnu::always_inline]] inline void sample_run(const PointRun& run, const SourcePlane& source,
                                              typename NeighbourPair<layout>::Sample* out) {
  using Pair = NeighbourPair<layout>;
  constexpr int kSamples = Pair::kInfo.samples;
  for (int first = 0; first < kSamples; first += Pair::kSamples) {
    PointNeighbours<layout> from;
    from.read(run, source, first);
    typename Pair::Sample samples[Pair::kSamples][kPointRun];
    [&]<int... k>(std::integer_sequence<int, k...>) __attribute__((always_inline)) {
      (interpolate_run<k>(run, from, samples[k]), ...);
    }
    (std::make_integer_sequence<int, Pair::kSamples>());
    for (int x = 0; x < kPointRun; ++x) {
      for (int k = 0; k < Pair::kSamples; ++k) out[x * kSamples + first + k] = samples[k][x];
    }
  }
}

/// Copies rows without gaps to a target.
[[gnu::always_inline]] inline void copy_rows(const std::uint8_t* from, int row_bytes,
                                             const TargetPlane& to) {
  std::uint8_t* out = to.data;
  const auto copy = [&](std::size_t bytes) __attribute__((always_inline)) {
    for (int y = 0; y < to.rows; ++y, from += bytes, out += to.stride) {
      std::memcpy(out, from, bytes);
    }
  };
  // A copy of known length is not a call.
  if (row_bytes == 16) {
    copy(16);
  } else if (row_bytes == 8) {
    copy(8);
  } else if (row_bytes == 4) {
    copy(4);
  } else {
    copy(static_cast<std::size_t>(row_bytes));
  }
}

/// Implements a kernel's PointJob: samples runs of pixels into memory of its own, then copies the
/// rows.
template <Layout layout>
void walk_points(const PointJob& job) {
  constexpr LayoutInfo kInfo = info(layout);
  const PointLimits<layout> limits(job.source);
  const auto stride = static_cast<std::int32_t>(job.source.stride);
  const std::int32_t *const places_u = job.places.u, *const places_v = job.places.v;
  const int count = job.target.columns * job.target.rows;
  alignas(64) typename NeighbourPair<layout>::Sample pixels[kTile * kTile * kInfo.samples];
  for (int first = 0; first < count; first += kPointRun) {
    PointRun run;
    run.place(places_u + first, places_v + first, limits, stride);
    sample_run<layout>(run, job.source, pixels + first * kInfo.samples);
  }
  copy_rows(reinterpret_cast<const std::uint8_t*>(pixels), job.target.columns * kInfo.out_bytes(),
            job.target);
}

/// Locates one axis of the places, by differences from run to run.
template <class Lanes>
[[gnu::always_inline]] inline void locate_axis(const PointAxis& axis, int columns, int count,
                                               std::int32_t* out) {
  using SignedLanes = decltype(Lanes{} == Lanes{});
  constexpr int kLanes = sizeof(Lanes) / 4;
  const auto columns_less_one = static_cast<std::uint32_t>(columns - 1);
  const auto column_bits = static_cast<std::uint32_t>(__builtin_popcount(columns_less_one));
  const std::uint32_t rows = kPointRun >> column_bits;
  const std::uint32_t growth = 2 * rows * rows * axis.yy;
  Lanes k{};
  for (int lane = 0; lane < kLanes; ++lane) k[lane] = static_cast<std::uint32_t>(lane);
  for (int part = 0; part < kPointRun; part += kLanes, k += kLanes) {
    const Lanes i = k & columns_less_one, j = k >> column_bits;
    Lanes value =
        axis.start + i * (axis.x + i * axis.xx + j * axis.xy) + j * (axis.y + j * axis.yy);
    Lanes step = rows * (axis.y + i * axis.xy + (2 * j + rows) * axis.yy);
    for (int first = part; first < count; first += kPointRun) {
      const SignedLanes whole = reinterpret_cast<SignedLanes>(value) >> PointAxis::kExtraBits;
      const SignedLanes place = axis.base + whole;
      std::memcpy(out + first, &place, sizeof place);
      value += step;
      step += growth;
    }
  }
}

/// Implements a kernel's locate(). `Lanes`: a vector of 32 bit.
template <class Lanes>
void walk_places(const PointMap& map, int columns, int rows, Places& places) {
  const int runs = (columns * rows + kPointRun - 1) / kPointRun;
  locate_axis<Lanes>(map.u, columns, runs * kPointRun, places.u);
  locate_axis<Lanes>(map.v, columns, runs * kPointRun, places.v);
}

/// Functions indexed by layout.
constexpr auto kPointWalks =
    by_layout<kLayouts>([]<Layout layout>() -> Kernel::Points { return walk_points<layout>; });

}  // namespace
}  // namespace orbwatch::remap
