#include "proc/remap/sampling/downsampling.h"

#include <algorithm>
#include <cassert>
#include <cstdlib>
#include <cstring>
#include <type_traits>
#include <utility>

namespace orbwatch::remap {
namespace {

template <class Sample>
Sample read(const std::uint8_t* from) {
  Sample sample = 0;
  std::memcpy(&sample, from, sizeof sample);
  return sample;
}

template <Layout layout>
void filter_row(const std::uint8_t* upper, const std::uint8_t* lower, std::uint8_t* out,
                int width) {
  constexpr LayoutInfo kInfo = info(layout);
  using Sample = std::conditional_t<kInfo.sample_bytes == 1, std::uint8_t, std::uint16_t>;
  for (int x = 0; x < width; ++x) {
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

constexpr std::array<BoxFilter, kLayouts> kFilters{
    filter_row<Layout::One8>,  filter_row<Layout::Two8>,        filter_row<Layout::Three8>,
    filter_row<Layout::Four8>, filter_row<Layout::FirstOfTwo8>, filter_row<Layout::OddOfFour8>,
    filter_row<Layout::One16>, filter_row<Layout::Three16>};

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

/// Steps further than that lead to another surface.
constexpr std::int32_t kFar = 64 << kFractionBits;

/// A quarter of the step from one pixel to a neighbour; 0 if that is on another surface.
Coordinate quarter_step(const Coordinate& from, const Coordinate& to) {
  if (!is_defined(to)) return {};
  const std::int64_t u = std::int64_t{to.u} - from.u, v = std::int64_t{to.v} - from.v;
  if (std::abs(u) > kFar || std::abs(v) > kFar) return {};
  return {static_cast<std::int32_t>(u / 4), static_cast<std::int32_t>(v / 4)};
}

/// A quarter of a step along one axis: the mean of that from the pixel before and that to the one
/// behind, or the one there is.
Coordinate mean_step(const Coordinate& here, const Coordinate* before, const Coordinate* behind) {
  Coordinate sum{};
  int count = 0;
  for (const auto& [neighbour, sign] : {std::pair{before, -1}, {behind, 1}}) {
    const Coordinate step = neighbour ? quarter_step(here, *neighbour) : Coordinate{};
    if (step.u == 0 && step.v == 0) continue;
    sum = {sum.u + sign * step.u, sum.v + sign * step.v};
    ++count;
  }
  return count == 2 ? Coordinate{sum.u / 2, sum.v / 2} : sum;
}

}  // namespace

BoxFilter box_filter(Layout layout) { return kFilters[static_cast<std::size_t>(layout)]; }

void keep_even_rows(const TargetPlane& fine, int row_bytes, const TargetPlane& out) {
  constexpr int kUnit = 8;  // a constant, for std::memcpy to be no call
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
      return keep_even<std::array<std::uint8_t, 3>>(fine, out);
    default:
      return keep_even<std::uint32_t>(fine, out);
  }
}

void at_half_steps(const CoordinateTile& tile, int columns, int rows, int left, int top,
                   CoordinateTile& quarter) {
  const auto beside = [&](int x, int y) {
    return x < 0 || y < 0 || x >= columns || y >= rows ? nullptr : &tile[y][x];
  };
  for (int y = top / 2; y < std::min(rows, (top + kTile) / 2); ++y) {
    for (int x = left / 2; x < std::min(columns, (left + kTile) / 2); ++x) {
      const Coordinate& here = tile[y][x];
      Coordinate along_x{}, along_y{};
      if (is_defined(here)) {
        along_x = mean_step(here, beside(x - 1, y), beside(x + 1, y));
        along_y = mean_step(here, beside(x, y - 1), beside(x, y + 1));
      }
      for (const int j : {0, 1}) {
        for (const int i : {0, 1}) {
          const int right = 2 * i - 1, down = 2 * j - 1;
          quarter[2 * y - top + j][2 * x - left + i] = {
              here.u + right * along_x.u + down * along_y.u,
              here.v + right * along_x.v + down * along_y.v};
        }
      }
    }
  }
}

void average(const OversampledTile& tile, Layout layout, const TargetPlane& out) {
  const std::ptrdiff_t stride = OversampledTile::stride(layout);
  const BoxFilter filter = box_filter(packed(layout));
  for (int y = 0; y < out.rows; ++y) {
    const std::uint8_t* upper = tile.samples.data() + 2 * y * stride;
    filter(upper, upper + stride, out.data + y * out.stride, out.columns);
  }
}

}  // namespace orbwatch::remap
