// SPDX-License-Identifier: Apache-2.0
#include "app/simulation/tracing/sensor_noise.h"

#include <gtest/gtest.h>

#include <cmath>

namespace orbwatch::app::simulation {
namespace {

std::vector<std::uint16_t> row(const SensorNoise& noise, std::uint64_t frame, std::uint64_t number,
                               std::uint16_t level = 7000) {
  std::vector<std::uint16_t> samples(1000, level);
  noise.add(std::span(samples), frame, number);
  return samples;
}

TEST(SensorNoise, HasItsSigmaAndNoOffset) {
  const SensorNoise noise(1.5, 1, 1000);
  double sum = 0, squares = 0;
  constexpr int kRows = 300;
  for (int i = 0; i < kRows; ++i) {
    for (const std::uint16_t sample : row(noise, 3, static_cast<std::uint64_t>(i))) {
      sum += sample - 7000.0;
      squares += (sample - 7000.0) * (sample - 7000.0);
    }
  }
  const double count = kRows * 1000.0;
  EXPECT_NEAR(sum / count, 0, 0.03);
  // Rounding to whole counts adds the variance of a uniform distribution.
  EXPECT_NEAR(std::sqrt(squares / count), std::sqrt(1.5 * 1.5 + 1.0 / 12), 0.03);
}

TEST(SensorNoise, FollowsFromSeedFrameAndRow) {
  const SensorNoise noise(2, 1, 1000);
  EXPECT_EQ(row(noise, 3, 4), row(SensorNoise(2, 1, 1000), 3, 4));
  EXPECT_NE(row(noise, 3, 4), row(noise, 3, 5));
  EXPECT_NE(row(noise, 3, 4), row(noise, 4, 4));
  EXPECT_NE(row(noise, 3, 4), row(SensorNoise(2, 2, 1000), 3, 4));
}

TEST(SensorNoise, SaturatesInsteadOfWrapping) {
  const SensorNoise noise(40, 1, 1000);
  std::vector<std::uint8_t> dark(1000, 3), bright(1000, 252);
  noise.add(std::span(dark), 1, 1);
  noise.add(std::span(bright), 1, 1);
  int black = 0, white = 0;
  for (std::size_t i = 0; i < 1000; ++i) {
    ASSERT_LT(dark[i], 203);
    ASSERT_GT(bright[i], 52);
    black += dark[i] == 0 ? 1 : 0;
    white += bright[i] == 255 ? 1 : 0;
  }
  EXPECT_GT(black, 300);
  EXPECT_GT(white, 300);
}

TEST(SensorNoise, IsNoneAtSigmaZero) {
  EXPECT_EQ(row(SensorNoise(0, 1, 1000), 3, 4), std::vector<std::uint16_t>(1000, 7000));
}

}  // namespace
}  // namespace orbwatch::app::simulation
