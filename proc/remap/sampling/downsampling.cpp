// SPDX-License-Identifier: Apache-2.0
#include "proc/remap/sampling/downsampling.h"

#include <cassert>
#include <cstring>
#include <type_traits>
#include <utility>

#include "proc/remap/sampling/box_run.h"

namespace orbwatch::remap {
namespace {

template <class Sample>
Sample read(const std::uint8_t* from) {
  Sample sample = 0;
  std::memcpy(&sample, from, sizeof sample);
  return sample;
}

template <Layout layout>
[[gnu::always_inline]] inline void filter_rest(const std::uint8_t* upper, const std::uint8_t* lower,
                                               std::uint8_t* out, int first, int width) {
  constexpr LayoutInfo kInfo = info(layout);
  using Sample = std::conditional_t<kInfo.sample_bytes == 1, std::uint8_t, std::uint16_t>;
  for (int x = first; x < width; ++x) {
    for (int k = 0; k < kInfo.samples; ++k) {
      const int sample = (kInfo.first + k * kInfo.every) * kInfo.sample_bytes;
      const int left = 2 * x * kInfo.pixel_bytes + sample, right = left + kInfo.pixel_bytes;
      const unsigned sum = read<Sample>(upper + left) + read<Sample>(upper + right) +
                           read<Sample>(lower + left) + read<Sample>(lower + right);
      const auto mean = static_cast<Sample>((sum + 2) / 4);
      std::memcpy(out + x * kInfo.pixel_bytes + sample, &mean, sizeof mean);
    }
  }
}

/// Implements BoxFilter.
template <Layout layout>
inline void filter_row(const std::uint8_t* upper, const std::uint8_t* lower, std::uint8_t* out,
                       int width) {
  constexpr int kRunPixels = box_run_pixels(layout);
  int x = 0;
  if constexpr (kRunPixels > 0) {
    constexpr int kBytes = info(layout).pixel_bytes;
    for (; x + kRunPixels <= width; x += kRunPixels) {
      box_run<layout>(upper + 2 * x * kBytes, lower + 2 * x * kBytes, out + x * kBytes);
    }
  }
  filter_rest<layout>(upper, lower, out, x, width);
}

template <Layout layout>
void average_tile(const OversampledTile& tile, const TargetPlane& out) {
  constexpr Layout kPacked = packed(layout);
  constexpr std::ptrdiff_t kStride = OversampledTile::stride(layout);
  const auto average_rows = [&](auto columns) __attribute__((always_inline)) {
    const std::uint8_t* upper = tile.samples.data();
    std::uint8_t* to = out.data;
    for (int y = 0; y < out.rows; ++y, upper += 2 * kStride, to += out.stride) {
      filter_row<kPacked>(upper, upper + kStride, to, columns);
    }
  };
  // Rows of known length need no loops.
  if (out.columns == kTile) {
    average_rows(std::integral_constant<int, kTile>());
  } else if (out.columns == kTile / 2) {
    average_rows(std::integral_constant<int, kTile / 2>());
  } else if (out.columns == kTile / 4) {
    average_rows(std::integral_constant<int, kTile / 4>());
  } else {
    average_rows(out.columns);
  }
}

/// Means of pairs of samples, the second of which comes `distance` samples after the first.
template <class Sample, int samples, bool along_x>
[[gnu::always_inline]] inline void average_pairs(const std::uint8_t* from, std::ptrdiff_t distance,
                                                 std::uint8_t* out, int columns) {
  for (int x = 0; x < columns; ++x) {
    for (int k = 0; k < samples; ++k) {
      const int first = (along_x ? 2 * x : x) * samples + k;
      const auto at = [from](std::ptrdiff_t n) {
        return unsigned{read<Sample>(from + n * std::ptrdiff_t{sizeof(Sample)})};
      };
      const auto mean = static_cast<Sample>((at(first) + at(first + distance) + 1) / 2);
      std::memcpy(out + (x * samples + k) * sizeof mean, &mean, sizeof mean);
    }
  }
}

template <Layout layout, bool along_x>
void average_pairs_of_tile(const OversampledTile& tile, const TargetPlane& out) {
  constexpr LayoutInfo kInfo = info(layout);
  using Sample = std::conditional_t<kInfo.sample_bytes == 1, std::uint8_t, std::uint16_t>;
  constexpr std::ptrdiff_t kStride = OversampledTile::stride(layout);
  constexpr std::ptrdiff_t kDistance =
      along_x ? kInfo.samples : kStride / std::ptrdiff_t{sizeof(Sample)};
  const auto average_rows = [&](auto columns) __attribute__((always_inline)) {
    const std::uint8_t* from = tile.samples.data();
    std::uint8_t* to = out.data;
    for (int y = 0; y < out.rows; ++y, from += along_x ? kStride : 2 * kStride, to += out.stride) {
      average_pairs<Sample, kInfo.samples, along_x>(from, kDistance, to, columns);
    }
  };
  if (out.columns == kTile) return average_rows(std::integral_constant<int, kTile>());
  if (out.columns == kTile / 2) return average_rows(std::integral_constant<int, kTile / 2>());
  average_rows(out.columns);
}

struct Filters {
  using Tile = void (*)(const OversampledTile&, const TargetPlane&);
  BoxFilter row;
  Tile tile, columns, rows;
};
template <std::size_t... n>
constexpr auto filters_of(std::index_sequence<n...>) {
  return std::array{Filters{filter_row<Layout{n}>, average_tile<Layout{n}>,
                            average_pairs_of_tile<Layout{n}, true>,
                            average_pairs_of_tile<Layout{n}, false>}...};
}
/// Filters, indexed by layout.
constexpr auto kFilters = filters_of(std::make_index_sequence<kLayouts>());

template <class Pixel>
void keep_even(const TargetPlane& fine, const TargetPlane& out) {
  std::array<Pixel, kTile> row;
  std::array<Pixel, kTile / 2> half;
  const int rows = out.rows;
  const std::uint8_t* from = fine.data;
  std::uint8_t* to = out.data;
  for (int y = 0; y < rows; ++y, from += fine.stride, to += out.stride) {
    std::memcpy(row.data(), from, sizeof row);
    for (std::size_t x = 0; x < half.size(); ++x) half[x] = row[2 * x];
    std::memcpy(to, half.data(), sizeof half);
  }
}

/// The same for pixels of three bytes. A row that is collected in memory first, as above, is read
/// back only when all its small stores are done.
void keep_even_threes(const TargetPlane& fine, const TargetPlane& out) {
  const int rows = out.rows;
  const std::uint8_t* from = fine.data;
  std::uint8_t* to = out.data;
  for (int y = 0; y < rows; ++y, from += fine.stride, to += out.stride) {
#pragma GCC unroll 8
    for (int x = 0; x < kTile / 2; ++x) std::memcpy(to + 3 * x, from + 6 * x, 3);
  }
}

}  // namespace

BoxFilter box_filter(Layout layout) { return kFilters[static_cast<std::size_t>(layout)].row; }

void keep_even_rows(const TargetPlane& fine, int row_bytes, const TargetPlane& out) {
  constexpr int kUnit = 8;  // a constant, so that std::memcpy is not a call
  assert(row_bytes % kUnit == 0 && fine.rows >= 2 * out.rows);
  const std::uint8_t* from = fine.data;
  std::uint8_t* to = out.data;
  for (int y = 0; y < out.rows; ++y, from += 2 * fine.stride, to += out.stride) {
    for (int x = 0; x < row_bytes; x += kUnit) std::memcpy(to + x, from + x, kUnit);
  }
}

void keep_even_columns(const TargetPlane& fine, int pixel_bytes, const TargetPlane& out) {
  assert(fine.columns == kTile && fine.rows >= out.rows);
  switch (pixel_bytes) {
    case 1:
      return keep_even<std::uint8_t>(fine, out);
    case 2:
      return keep_even<std::uint16_t>(fine, out);
    case 3:
      return keep_even_threes(fine, out);
    default:
      return keep_even<std::uint32_t>(fine, out);
  }
}

void average(const OversampledTile& tile, Layout layout, TwiceAlong twice, const TargetPlane& out) {
  assert(twice.x || twice.y);
  const Filters& filters = kFilters[static_cast<std::size_t>(layout)];
  if (twice.x && twice.y) return filters.tile(tile, out);
  (twice.x ? filters.columns : filters.rows)(tile, out);
}

}  // namespace orbwatch::remap
