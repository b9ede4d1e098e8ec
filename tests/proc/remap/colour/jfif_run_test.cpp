// SPDX-License-Identifier: Apache-2.0
#include "proc/remap/colour/jfif_run.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cstdint>
#include <random>

#include "proc/remap/colour/colour_conversion.h"

/// Runs of pixels, in the processor's instructions, have the results of one pixel after the other.
namespace orbwatch::remap {
namespace {

using Row = std::array<std::uint8_t, std::size_t{3} * kRun>;

/// Many samples at the ends of their range.
Row random_row(std::mt19937& random) {
  Row row;
  for (std::uint8_t& sample : row) {
    sample = static_cast<std::uint8_t>(random() % 3 == 0 ? 255 * (random() % 2) : random());
  }
  return row;
}

/// Chroma of two by two pixels.
int chroma_of(const Row& upper, const Row& lower, int pair, const ChromaWeights& weights) {
  std::array<int, 3> sums{};
  for (int n = 0; n < 6; ++n) {
    sums[n % 3] += upper[6 * pair + n] + lower[6 * pair + n];
  }
  const int weighted = weights.red * sums[0] + weights.green * sums[1] + weights.blue * sums[2];
  return std::min((weighted + kChromaOffset) >> kChromaBits, 255);
}

TEST(JfifRun, LumaIsThatOfEachPixel) {
  std::mt19937 random(6);
  for (int n = 0; n < 2000; ++n) {
    const Row row = random_row(random);
    SampleRun grey;
    luma_run(row.data(), grey.data());
    for (int x = 0; x < kRun; ++x) ASSERT_EQ(grey[x], luma(&row[3 * x])) << n << ", " << x;
  }
}

TEST(JfifRun, ChromaIsThatOfEachFourPixels) {
  std::mt19937 random(7);
  for (int n = 0; n < 2000; ++n) {
    const Row upper = random_row(random), lower = random_row(random);
    const ChromaRuns chroma = chroma_run(upper.data(), lower.data());
    for (int i = 0; i < kRun / 2; ++i) {
      ASSERT_EQ(chroma.u[i], chroma_of(upper, lower, i, kWeightsOfU)) << n << ", " << i;
      ASSERT_EQ(chroma.v[i], chroma_of(upper, lower, i, kWeightsOfV)) << n << ", " << i;
    }
  }
}

TEST(JfifRun, SeparatesPairs) {
  SampleRun pairs;
  for (int i = 0; i < kRun; ++i) pairs[i] = static_cast<std::uint8_t>(3 * i);
  const ChromaRuns chroma = separated(pairs.data());
  for (int i = 0; i < kRun / 2; ++i) {
    EXPECT_EQ(chroma.u[i], 6 * i);
    EXPECT_EQ(chroma.v[i], 6 * i + 3);
  }
}

TEST(JfifRun, StretchesEverySampleOfTheLimitedRange) {
  for (int first = 0; first < 256; first += kRun / 2) {
    ChromaRun chroma;
    for (int i = 0; i < kRun / 2; ++i) chroma[i] = static_cast<std::uint8_t>(first + i);
    stretch(chroma);
    for (int i = 0; i < kRun / 2; ++i) {
      const int scaled = (first + i - kNeutralChroma) * kStretch + (1 << (kStretchBits - 1));
      const int full = std::clamp((scaled >> kStretchBits) + kNeutralChroma, 0, 255);
      ASSERT_EQ(chroma[i], full) << first + i;
    }
  }
}

TEST(JfifRun, LuminanceIsThatOfEachPixel) {
  for (const auto range : {ColourRange::Full, ColourRange::Limited}) {
    const YuvToRgb convert({ColourMatrix::Bt601, range});
    for (int first = 0; first < 256; first += kRun) {
      SampleRun luminance;
      for (int x = 0; x < kRun; ++x) luminance[x] = static_cast<std::uint8_t>(first + x);
      const SampleRun luma = convert.luma(luminance);
      for (int x = 0; x < kRun; ++x) ASSERT_EQ(luma[x], convert.luma(first + x)) << first + x;
    }
  }
}

}  // namespace
}  // namespace orbwatch::remap
