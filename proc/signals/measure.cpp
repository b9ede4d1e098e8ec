#include "proc/signals/measure.h"

#include <cmath>

#include "proc/optics/angle.h"

namespace orbwatch::signals {

Signals hot_spot_signals(const HotSpot& hot_spot, const RadiometricScale& scale,
                         double full_scale) {
  Signals signals;
  signals.hot_spot_area = hot_spot.solid_angle * 1000;
  if (!hot_spot.present) return signals;
  const optics::Vec3& d = hot_spot.direction;
  // The frame path's only trigonometry: twice per frame set, none per pixel.
  signals.hot_spot_yaw = optics::degrees(std::atan2(d.x, d.y));
  signals.hot_spot_pitch = optics::degrees(std::atan2(d.z, std::hypot(d.x, d.y)));
  signals.hot_spot_peak_intensity = 100 * hot_spot.peak / full_scale;
  signals.hot_spot_mean_intensity = 100 * hot_spot.mean / full_scale;
  if (scale.is_radiometric()) {
    signals.hot_spot_peak_temperature = scale.celsius(hot_spot.peak);
    signals.hot_spot_mean_temperature = scale.celsius(hot_spot.mean);
  }
  return signals;
}

}  // namespace orbwatch::signals
