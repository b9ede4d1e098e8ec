// SPDX-License-Identifier: Apache-2.0
#include "proc/remap/sampling/sharpening.h"
#include "tests/proc/remap/untouched.h"
#include "tests/support/guarded_memory.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstring>
#include <random>
#include <span>
#include <vector>

namespace orbwatch::remap {
namespace {

using tests::GuardedMemory;
using tests::kUntouched;

/// Rows of samples, each in memory of its own.
class Rows {
 public:
  explicit Rows(std::size_t most) : above_(most), row_(most), below_(most), out_(most) {}

  /// Fills the rows with random samples, with `extreme` only 0 and 255; at the end of their memory
  /// or at its beginning.
  RowsAround fill(std::mt19937& random, int samples, int pixel_samples, bool extreme, bool at_end) {
    const auto bytes = static_cast<std::size_t>(samples);
    const auto filled = [&](GuardedMemory& memory) {
      const auto span = at_end ? memory.last(bytes) : memory.first(bytes);
      for (std::uint8_t& sample : span) {
        sample = static_cast<std::uint8_t>(extreme ? random() % 2 * 255 : random());
      }
      return span.data();
    };
    out = at_end ? out_.last(bytes) : out_.first(bytes);
    std::ranges::fill(out, kUntouched);
    return {filled(above_), filled(row_), filled(below_), samples, pixel_samples};
  }

  std::span<std::uint8_t> out;

 private:
  GuardedMemory above_, row_, below_, out_;
};

int floor_divided(int value, int divisor) {
  return static_cast<int>(std::floor(static_cast<double>(value) / divisor));
}

/// The specification, sample by sample.
std::uint8_t specified(const RowsAround& rows, int i, int gain) {
  const int step = rows.pixel_samples;
  const auto at = [&](const std::uint8_t* row, int pixels) {
    const int place = i + pixels * step;
    return static_cast<int>(row[place < 0 || place >= rows.samples ? i : place]);
  };
  const int beside = at(rows.above, 0) + at(rows.below, 0) + at(rows.row, -1) + at(rows.row, 1);
  const int corners =
      at(rows.above, -1) + at(rows.above, 1) + at(rows.below, -1) + at(rows.below, 1);
  const int difference = 60 * at(rows.row, 0) - 11 * beside - 4 * corners;
  const int eighths = floor_divided(difference * gain, 1 << 15);
  return static_cast<std::uint8_t>(
      std::clamp(at(rows.row, 0) + floor_divided(eighths + 4, 8), 0, 255));
}

/// Layout of a row's samples, and gains of those that are sharpened.
struct Form {
  const char* name;
  int pixel_samples;
  std::array<bool, 2> sharpened;
};
class SharpenedRowOf : public testing::TestWithParam<Form> {};

TEST_P(SharpenedRowOf, IsTheSpecificationsAndReadsNothingElse) {
  const auto& [name, pixel_samples, sharpened] = GetParam();
  constexpr int kMostPixels = 129;
  Rows memory(kMostPixels * 4);
  std::mt19937 random(1);
  const auto any = [&random](int count) { return static_cast<int>(random() % count); };
  for (int pixels = 1; pixels <= kMostPixels; ++pixels) {
    const int pair = pixel_samples == 2 ? 2 : 1;
    const int samples = (pixels + pair - 1) / pair * pair * pixel_samples;
    for (const double sharpness : {0.0, 0.05, 0.8, kMaxSharpness}) {
      const std::int16_t gain = sharpening_gain(sharpness);
      const SharpeningGains gains{sharpened[0] ? gain : std::int16_t{0},
                                  sharpened[1] ? gain : std::int16_t{0}};
      for (int turn = 0; turn < 4; ++turn) {
        const RowsAround rows =
            memory.fill(random, samples, pixel_samples, turn % 2 == 0, turn / 2 == 0);
        const bool is_whole = turn == 0;
        const int first = is_whole ? 0 : any(samples + 1);
        const int last = is_whole ? samples : first + any(samples - first + 1);
        sharpen_row(rows, gains, first, last, memory.out.data());
        for (int i = 0; i < samples; ++i) {
          const std::uint8_t expected =
              i < first || i >= last ? kUntouched : specified(rows, i, gains[i % 2]);
          ASSERT_EQ(memory.out[i], expected) << samples << " samples, " << first << " to " << last
                                             << ", sharpness " << sharpness << ", sample " << i;
        }
      }
    }
  }
}

INSTANTIATE_TEST_SUITE_P(All, SharpenedRowOf,
                         testing::Values(Form{"plane", 1, {true, true}},
                                         Form{"yuyv", 2, {true, false}},
                                         Form{"uyvy", 2, {false, true}},
                                         Form{"rgb", 3, {true, true}},
                                         Form{"bgra", 4, {true, true}}),
                         [](const auto& test) { return std::string(test.param.name); });

// Half of a count is the rounding to 8 bit, and an eighth of half that to eighths before.
TEST(SharpenRow, IsAnUnsharpMaskByAGaussFilter) {
  constexpr int kSamples = 64;
  constexpr double kSigma = 0.703, kSharpness = 0.8;
  Rows memory(kSamples);
  std::mt19937 random(2);
  const RowsAround rows = memory.fill(random, kSamples, 1, false, false);
  const std::int16_t gain = sharpening_gain(kSharpness);
  sharpen_row(rows, {gain, gain}, 0, kSamples, memory.out.data());
  const double beside = std::exp(-1 / (2 * kSigma * kSigma)), total = 1 + 2 * beside;
  for (int i = 1; i + 1 < kSamples; ++i) {
    const auto across = [&](const std::uint8_t* row) {
      return (row[i] + beside * (row[i - 1] + row[i + 1])) / total;
    };
    const double mean =
        (across(rows.row) + beside * (across(rows.above) + across(rows.below))) / total;
    const double sharp = rows.row[i] + kSharpness * (rows.row[i] - mean);
    EXPECT_NEAR(memory.out[i], std::clamp(sharp, 0.0, 255.0), 0.75) << i;
  }
}

}  // namespace
}  // namespace orbwatch::remap
