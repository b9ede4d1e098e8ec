#pragma once

#include <limits>

namespace orbwatch::signals {

/// What a hot spot can be, on the machine's surface; what cannot is a spark.
struct HotSpotLimits {
  static constexpr double kAny = std::numeric_limits<double>::infinity();

  double min_area = 0;      ///< mm2
  double max_speed = kAny;  ///< mm/s, of its centroid

  bool need_surface() const { return min_area > 0 || max_speed < kAny; }
};

}  // namespace orbwatch::signals
