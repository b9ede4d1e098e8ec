// SPDX-License-Identifier: Apache-2.0
#include "app/simulation/tracing/sensor_noise.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include "app/simulation/scene/hash.h"

namespace orbwatch::app::simulation {
namespace {

constexpr std::size_t kOffsets = std::size_t{1} << 18;

/// Normal random number (Box-Muller transform).
double normal(std::uint64_t seed, std::uint64_t index) {
  const double radius = std::sqrt(-2 * std::log(1 - uniform(seed, index, 0)));
  return radius * std::cos(2 * std::numbers::pi * uniform(seed, index, 1));
}

}  // namespace

SensorNoise::SensorNoise(double sigma, std::uint64_t seed, std::size_t row_samples) : seed_(seed) {
  if (sigma <= 0) return;
  constexpr double kLimit = std::numeric_limits<std::int16_t>::max();
  table_.resize(kOffsets + row_samples);
  for (std::size_t i = 0; i < table_.size(); ++i) {
    const double counts = std::round(sigma * normal(seed, i));
    table_[i] = static_cast<std::int16_t>(std::clamp(counts, -kLimit, kLimit));
  }
}

template <class Sample>
void SensorNoise::add(std::span<Sample> row, std::uint64_t frame, std::uint64_t row_number) const {
  if (table_.empty()) return;
  constexpr int kFullScale = std::numeric_limits<Sample>::max();
  const std::int16_t* noise = table_.data() + mix(mix(mix(seed_) ^ frame) ^ row_number) % kOffsets;
  for (std::size_t i = 0; i < row.size(); ++i) {
    row[i] = static_cast<Sample>(std::clamp(row[i] + noise[i], 0, kFullScale));
  }
}

template void SensorNoise::add(std::span<std::uint8_t>, std::uint64_t, std::uint64_t) const;
template void SensorNoise::add(std::span<std::uint16_t>, std::uint64_t, std::uint64_t) const;

}  // namespace orbwatch::app::simulation
