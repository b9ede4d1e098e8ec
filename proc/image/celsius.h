// SPDX-License-Identifier: Apache-2.0
#pragma once

namespace orbwatch {

inline constexpr double kZeroCelsius = 273.15;  ///< K

/// A radiometric camera's linear scale: T[K] = kelvin_per_count * count + kelvin_offset. Both
/// functions need kelvin_per_count above 0; reentrant.
inline double kelvin_of_counts(double counts, double kelvin_per_count, double kelvin_offset) {
  return counts * kelvin_per_count + kelvin_offset;
}
inline double counts_of_kelvin(double kelvin, double kelvin_per_count, double kelvin_offset) {
  return (kelvin - kelvin_offset) / kelvin_per_count;
}

}  // namespace orbwatch
