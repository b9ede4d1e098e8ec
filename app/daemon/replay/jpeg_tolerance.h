// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <string_view>

namespace orbwatch::app::daemon {

/// Difference that JPEG makes to a signal of luminance: the larger one of both bounds it.
struct JpegTolerance {
  std::string_view signal;
  double absolute = 0;  ///< in the signal's unit
  double share = 0;     ///< share of the larger value
};

/// Least quality for which the tolerances hold.
inline constexpr int kLeastJpegQuality = 90;

/// Twice the largest differences or more that jpeg_tolerance_test and replay_test measure at that
/// quality, see README.md. Other signals have none: whether a spark is followed depends on single
/// pixels.
inline constexpr std::array kJpegTolerances{
    JpegTolerance{"hot_spot_pixels", 4, 0.02},
    JpegTolerance{"hot_spot_solid_angle", 0.025, 0.02},
    JpegTolerance{"hot_spot_area", 6, 0.02},
    JpegTolerance{"hot_spot_length", 0.25, 0.02},
    JpegTolerance{"hot_spot_width", 0.25, 0.02},
    JpegTolerance{"hot_spot_width_error", 0.25, 0},
    JpegTolerance{"hot_spot_orientation_xy", 3, 0},
    JpegTolerance{"hot_spot_length_angle", 0.05, 0.02},
    JpegTolerance{"hot_spot_width_angle", 0.03, 0.02},
    JpegTolerance{"hot_spot_orientation", 8, 0},
    JpegTolerance{"hot_spot_yaw", 0.03, 0},
    JpegTolerance{"hot_spot_pitch", 0.03, 0},
    JpegTolerance{"hot_spot_x", 0.1, 0},
    JpegTolerance{"hot_spot_y", 0.1, 0},
    JpegTolerance{"hot_spot_z", 0.1, 0},
    JpegTolerance{"hot_spot_mean_intensity", 2, 0},
    JpegTolerance{"hot_spot_peak_intensity", 2, 0},
    JpegTolerance{"hot_spot_saturated", 100, 0},  // 254 is not full scale
    JpegTolerance{"plume_area", 0.25, 0.03},
    JpegTolerance{"spatter_count", 4, 0},
    JpegTolerance{"spatter_rate", 6, 0},
    JpegTolerance{"hot_spot_area_mean", 6, 0.02},
    JpegTolerance{"hot_spot_area_deviation", 2, 0},
    JpegTolerance{"hot_spot_area_trend", 70, 0},
    JpegTolerance{"hot_spot_width_mean", 0.25, 0.02},
    JpegTolerance{"hot_spot_width_deviation", 0.12, 0},
    JpegTolerance{"hot_spot_width_trend", 6, 0},
    JpegTolerance{"hot_spot_mean_intensity_mean", 2, 0},
    JpegTolerance{"hot_spot_mean_intensity_deviation", 0.25, 0},
    JpegTolerance{"hot_spot_mean_intensity_trend", 6, 0},
    JpegTolerance{"spatter_rate_mean", 4, 0},
    JpegTolerance{"spatter_rate_deviation", 1.5, 0},
    JpegTolerance{"spatter_rate_trend", 15, 0},
    JpegTolerance{"hot_spot_confidence", 2.5, 0}};

/// True: JPEG of this quality explains the difference between two values of a signal. Reentrant.
inline bool is_explained_by_jpeg(std::string_view signal, int quality, double recorded,
                                 double computed) {
  const auto found = std::ranges::find(kJpegTolerances, signal, &JpegTolerance::signal);
  if (quality < kLeastJpegQuality || found == kJpegTolerances.end()) return false;
  const double larger = std::max(std::abs(recorded), std::abs(computed));
  return std::abs(recorded - computed) <= std::max(found->absolute, found->share * larger);
}

}  // namespace orbwatch::app::daemon
