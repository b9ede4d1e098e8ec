// SPDX-License-Identifier: Apache-2.0
#include "proc/remap/sampling/downsampling.h"

#include <gtest/gtest.h>

#include <cmath>
#include <cstring>
#include <random>
#include <vector>

#include "proc/remap/grid/coordinate.h"
#include "tests/proc/remap/untouched.h"

namespace orbwatch::remap {
namespace {

using tests::kUntouched;

/// Offsets of a layout's samples in a pixel, bytes: written down by hand.
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

class BoxFilterOf : public testing::TestWithParam<Layout> {};

TEST_P(BoxFilterOf, WritesMeansRoundedToNearestAndNothingElse) {
  const int pixel = info(GetParam()).pixel_bytes, bytes = info(GetParam()).sample_bytes;
  std::mt19937 random(1);
  for (int width = 1; width <= 40; ++width) {
    const bool extreme = width % 3 == 0;
    std::vector<std::byte> upper(2 * width * pixel), lower(upper.size());
    for (auto* row : {&upper, &lower}) {
      for (std::byte& b : *row)
        b = static_cast<std::byte>(extreme ? (random() % 2) * 255 : random());
    }
    std::vector<std::byte> out(width * pixel, std::byte{kUntouched}), expected = out;
    box_filter(GetParam())(reinterpret_cast<const std::uint8_t*>(upper.data()),
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

INSTANTIATE_TEST_SUITE_P(All, BoxFilterOf,
                         testing::Values(Layout::One8, Layout::Two8, Layout::Three8, Layout::Four8,
                                         Layout::FirstOfTwo8, Layout::OddOfFour8, Layout::One16,
                                         Layout::Three16));

TEST(KeepEven, ColumnIsCopiedWholeAndNothingElse) {
  constexpr int kRows = 7;
  constexpr std::uint8_t kUnwritten = 255;
  for (int pixel = 1; pixel <= 4; ++pixel) {
    const std::ptrdiff_t fine_stride = kTile * pixel + 5, stride = kTile / 2 * pixel + 3;
    std::vector<std::uint8_t> fine(kRows * fine_stride), out(kRows * stride, kUnwritten);
    for (std::size_t i = 0; i < fine.size(); ++i) fine[i] = static_cast<std::uint8_t>(i % 251);
    keep_even_columns({fine.data(), fine_stride, kTile, kRows}, pixel,
                      {out.data(), stride, kTile / 2, kRows});
    for (int y = 0; y < kRows; ++y) {
      for (int byte = 0; byte < stride; ++byte) {
        const int x = byte / pixel;
        const bool inside = x < kTile / 2;
        const auto from = static_cast<std::size_t>(y * fine_stride + 2 * x * pixel + byte % pixel);
        ASSERT_EQ(out[static_cast<std::size_t>(y * stride + byte)],
                  inside ? fine[from] : kUnwritten)
            << pixel << " bytes, row " << y << ", byte " << byte;
      }
    }
  }
}

TEST(KeepEven, RowIsCopiedWholeAndNothingElse) {
  constexpr int kRows = 5;
  constexpr std::uint8_t kUnwritten = 255;
  for (int bytes = 8; bytes <= 64; bytes += 8) {
    const std::ptrdiff_t fine_stride = bytes + 5, stride = bytes + 3;
    std::vector<std::uint8_t> fine(2 * kRows * fine_stride), out(kRows * stride, kUnwritten);
    for (std::size_t i = 0; i < fine.size(); ++i) fine[i] = static_cast<std::uint8_t>(i % 251);
    keep_even_rows({fine.data(), fine_stride, kTile, 2 * kRows}, bytes,
                   {out.data(), stride, kTile, kRows});
    for (int y = 0; y < kRows; ++y) {
      for (int x = 0; x < stride; ++x) {
        const auto from = static_cast<std::size_t>(2 * y * fine_stride + x);
        ASSERT_EQ(out[static_cast<std::size_t>(y * stride + x)],
                  x < bytes ? fine[from] : kUnwritten);
      }
    }
  }
}

/// A sample of a packed row.
unsigned sample_of(const std::uint8_t* row, int sample, int bytes) {
  std::uint16_t value = 0;
  std::memcpy(&value, row + sample * bytes, static_cast<std::size_t>(bytes));
  return value;
}

/// Checks means of `across` x `down` samples.
void expect_means(int across, int down) {
  std::mt19937 random(3);
  OversampledTile tile;
  for (std::uint8_t& byte : tile.samples) byte = static_cast<std::uint8_t>(random());
  for (std::size_t n = 0; n < kLayouts; ++n) {
    const auto layout = static_cast<Layout>(n);
    const LayoutInfo& facts = info(layout);
    const std::ptrdiff_t from = OversampledTile::stride(layout);
    for (const auto& [columns, rows] : {std::pair{16, 16}, {8, 16}, {8, 8}}) {
      SCOPED_TRACE(testing::Message() << "layout " << n << ' ' << columns << 'x' << rows);
      const std::ptrdiff_t used = columns * facts.out_bytes(), stride = used + 5;
      std::vector<std::uint8_t> out(rows * stride, kUntouched);
      average(tile, layout, {across == 2, down == 2}, {out.data(), stride, columns, rows});
      for (int y = 0; y < rows; ++y) {
        const std::uint8_t* const upper = tile.samples.data() + down * y * from;
        for (int k = 0; k < columns * facts.samples; ++k) {
          const int left = k / facts.samples * across * facts.samples + k % facts.samples;
          double sum = 0;
          for (int n = 0; n < across * down; ++n) {
            sum += sample_of(upper + n / across * from, left + n % across * facts.samples,
                             facts.sample_bytes);
          }
          ASSERT_EQ(sample_of(&out[y * stride], k, facts.sample_bytes),
                    std::floor(sum / (across * down) + 0.5))
              << k << ' ' << y;
        }
        for (std::ptrdiff_t k = used; k < stride; ++k) ASSERT_EQ(out[y * stride + k], kUntouched);
      }
    }
  }
}

TEST(Average, IsTheMeanOfFourOrTwoInEveryLayout) {
  expect_means(2, 2);
  expect_means(2, 1);
  expect_means(1, 2);
}

}  // namespace
}  // namespace orbwatch::remap
