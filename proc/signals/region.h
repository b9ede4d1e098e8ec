#pragma once

#include <optional>
#include <vector>

#include "proc/optics/ball.h"
#include "proc/optics/scene_proxy.h"
#include "proc/optics/vec.h"
#include "proc/signals/radiometry.h"
#include "proc/signals/signals.h"

namespace orbwatch::signals {

/// What is measured in one region of interest, and by which thresholds. Counts are those of the
/// measured plane; Radiometry::counts() makes them from temperatures.
struct RegionSettings {
  /// Corners of a spherical polygon in either sense of rotation: vectors of any length from the
  /// ball's centre, machine frame. It must fit into half of the sphere. Empty: the whole view.
  std::vector<optics::Vec3> outline;
  double hot_spot_threshold = 0;              ///< counts at which a pixel belongs to the hot spot
  std::optional<double> plume_threshold{};    ///< counts, below the hot spot's
  std::optional<double> spatter_threshold{};  ///< counts at which a pixel is a spark's
  std::optional<double> width_set_point{};    ///< mm
  double full_scale = 65535;                  ///< largest count that the camera gives
  RadiometrySettings radiometry;
};

/// What is known of the machine's geometry.
struct RegionScene {
  optics::Ball ball;
  optics::SceneProxy proxy;
};

/// What these settings provide of what signals require. `has_scene`: the proxy is not far away.
inline Requires provided_by(const RegionSettings& settings, bool has_scene) {
  using enum Requires;
  return (settings.spatter_threshold ? SpatterThreshold : Nothing) |
         (settings.plume_threshold ? PlumeThreshold : Nothing) |
         (settings.width_set_point ? WidthSetPoint : Nothing) |
         (settings.radiometry.kelvin_per_count > 0 ? RadiometricCamera : Nothing) |
         (has_scene ? Scene : Nothing);
}

}  // namespace orbwatch::signals
