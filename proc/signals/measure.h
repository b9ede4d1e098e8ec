#pragma once

#include "proc/signals/hot_spot.h"
#include "proc/signals/signals.h"

namespace orbwatch::signals {

/// How a radiometric camera's counts stand for temperature: T[K] = kelvin_per_count * count.
struct RadiometricScale {
  double kelvin_per_count = 0;  ///< 0: the camera is not radiometric

  bool is_radiometric() const { return kelvin_per_count > 0; }
  double celsius(double counts) const { return counts * kelvin_per_count - 273.15; }
  double counts(double celsius) const { return (celsius + 273.15) / kelvin_per_count; }
};

/// The signals of a hot spot. `full_scale`: the largest count of the measured plane. Temperatures
/// are apparent ones (the ball's reflectivity is not accounted for) and only there for a
/// radiometric camera. Reentrant.
Signals hot_spot_signals(const HotSpot& hot_spot, const RadiometricScale& scale, double full_scale);

}  // namespace orbwatch::signals
