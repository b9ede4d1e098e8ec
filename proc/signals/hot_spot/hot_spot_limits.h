// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <limits>

namespace orbwatch::signals {

/// Limits of a hot spot on the machine's surface; blobs beyond them are sparks.
struct HotSpotLimits {
  static constexpr double kAny = std::numeric_limits<double>::infinity();

  double min_area = 0;      ///< mm2
  double max_speed = kAny;  ///< mm/s, speed of its centroid

  bool need_surface() const { return min_area > 0 || max_speed < kAny; }
};

}  // namespace orbwatch::signals
