#include "proc/remap/sampling/downsampling.h"

#include <array>
#include <cassert>
#include <cstdint>
#include <cstring>
#include <type_traits>

#include "proc/remap/grid/coordinate.h"

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

}  // namespace orbwatch::remap
