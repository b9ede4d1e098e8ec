// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <span>
#include <vector>

namespace orbwatch::app::simulation {

/// Gaussian noise in integer counts from one random table, with another offset for each row of each
/// frame. Deterministic by seed, frame and row. Immutable; reentrant.
class SensorNoise {
 public:
  /// `sigma` in counts, 0 for none; rows have at most `row_samples` samples.
  SensorNoise(double sigma, std::uint64_t seed, std::size_t row_samples);

  /// Adds noise to one row, saturating. No allocation.
  template <class Sample>
  void add(std::span<Sample> row, std::uint64_t frame, std::uint64_t row_number) const;

 private:
  std::uint64_t seed_;
  std::vector<std::int16_t> table_;  ///< empty: no noise
};

extern template void SensorNoise::add(std::span<std::uint8_t>, std::uint64_t, std::uint64_t) const;
extern template void SensorNoise::add(std::span<std::uint16_t>, std::uint64_t, std::uint64_t) const;

}  // namespace orbwatch::app::simulation
