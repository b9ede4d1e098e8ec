#pragma once

namespace orbwatch {

inline constexpr double kZeroCelsius = 273.15;  ///< K

}  // namespace orbwatch
