#include "proc/remap/halving.h"

#include <gtest/gtest.h>

#include <cmath>
#include <cstring>
#include <random>
#include <vector>

namespace orbwatch::remap {
namespace {

constexpr std::byte kUntouched{0xa5};

/// Where a layout's samples stand in a pixel, bytes: written down once more, by hand.
std::vector<int> sample_places(Layout layout) {
  switch (layout) {
    case Layout::One8:
    case Layout::FirstOfTwo8:
    case Layout::One16:
      return {0};
    case Layout::Two8:
      return {0, 1};
    case Layout::Three8:
      return {0, 1, 2};
    case Layout::Four8:
      return {0, 1, 2, 3};
    case Layout::OddOfFour8:
      return {1, 3};
    case Layout::Three16:
      return {0, 2, 4};
  }
  return {};
}

unsigned read(const std::vector<std::byte>& row, int place, int bytes) {
  std::uint16_t value = 0;
  std::memcpy(&value, &row[static_cast<std::size_t>(place)], static_cast<std::size_t>(bytes));
  return value;
}

class HalveRowOf : public testing::TestWithParam<Layout> {};

TEST_P(HalveRowOf, WritesMeansRoundedToNearestAndNothingElse) {
  const int pixel = info(GetParam()).pixel_bytes, bytes = info(GetParam()).sample_bytes;
  std::mt19937 random(1);
  for (int width = 1; width <= 40; ++width) {
    const bool extreme = width % 3 == 0;
    std::vector<std::byte> upper(2 * width * pixel), lower(upper.size());
    for (auto* row : {&upper, &lower}) {
      for (std::byte& b : *row)
        b = static_cast<std::byte>(extreme ? (random() % 2) * 255 : random());
    }
    std::vector<std::byte> out(width * pixel, kUntouched), expected = out;
    halve_row(GetParam())(reinterpret_cast<const std::uint8_t*>(upper.data()),
                          reinterpret_cast<const std::uint8_t*>(lower.data()),
                          reinterpret_cast<std::uint8_t*>(out.data()), width);
    for (int x = 0; x < width; ++x) {
      for (const int place : sample_places(GetParam())) {
        const int left = 2 * x * pixel + place, right = left + pixel;
        const double mean = (read(upper, left, bytes) + read(upper, right, bytes) +
                             read(lower, left, bytes) + read(lower, right, bytes)) /
                            4.0;
        const auto rounded = static_cast<std::uint16_t>(std::lround(mean));
        std::memcpy(&expected[x * pixel + place], &rounded, bytes);
      }
    }
    ASSERT_EQ(out, expected) << width;
  }
}

INSTANTIATE_TEST_SUITE_P(All, HalveRowOf,
                         testing::Values(Layout::One8, Layout::Two8, Layout::Three8, Layout::Four8,
                                         Layout::FirstOfTwo8, Layout::OddOfFour8, Layout::One16,
                                         Layout::Three16));

}  // namespace
}  // namespace orbwatch::remap
