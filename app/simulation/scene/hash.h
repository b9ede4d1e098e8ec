// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>

namespace orbwatch::app::simulation {

/// Mixes every bit of `value` into the result (SplitMix64's finaliser, Steele et al. 2014): random
/// numbers by index instead of by order, so that any moment can be computed by itself.
/// Reentrant.
constexpr std::uint64_t mix(std::uint64_t value) {
  value += 0x9e3779b97f4a7c15;
  value = (value ^ (value >> 30)) * 0xbf58476d1ce4e5b9;
  value = (value ^ (value >> 27)) * 0x94d049bb133111eb;
  return value ^ (value >> 31);
}

/// Uniform random number in [0, 1) for an index of a stream.
constexpr double uniform(std::uint64_t seed, std::uint64_t index, std::uint64_t channel) {
  return static_cast<double>(mix(mix(mix(seed) ^ index) ^ channel) >> 11) * 0x1p-53;
}

}  // namespace orbwatch::app::simulation
