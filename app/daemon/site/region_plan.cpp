// SPDX-License-Identifier: Apache-2.0
#include "app/daemon/site/region_plan.h"

#include <iomanip>
#include <optional>
#include <sstream>
#include <string>
#include <utility>
#include <vector>

#include "app/pipeline/views/source_colours.h"
#include "proc/optics/rotation.h"
#include "proc/signals/hot_spot/assumed_limits.h"

namespace orbwatch::app::daemon {
namespace {

/// From the ball's centre to the corners.
std::vector<optics::Vec3> outline_of(const pipeline::RegionOfInterest& region,
                                     const optics::Vec3& centre) {
  std::vector<optics::Vec3> corners;
  for (const auto& [yaw, pitch] : region.directions) {
    corners.push_back(optics::rotation({yaw, pitch, 0}) * optics::Vec3{0, 1, 0});
  }
  for (const auto& [x, y, z] : region.points) corners.push_back(optics::Vec3{x, y, z} - centre);
  return corners;
}

/// Error: the camera's counts do not reach a threshold, degC for a radiometric camera, else percent
/// of full scale.
Result<> check_threshold(const char* key, double value, double counts,
                         const signals::Radiometry& scale, double full_scale) {
  if (counts > 0 && counts <= full_scale) return {};
  std::ostringstream text;
  text << std::fixed << std::setprecision(1) << key << " is " << value;
  if (!scale.is_radiometric()) {
    text << "; it must be above 0 and at most 100 percent of full scale";
  } else if (counts > 0) {
    text << " degC; the camera's counts end at " << scale.celsius(full_scale) << " degC";
  } else {
    text << " degC, which is below the camera's first count";
  }
  return fail(text.str());
}

/// The region's thresholds in counts.
Result<> set_thresholds(const pipeline::RegionOfInterest& region, const hal::StreamFormat& format,
                        signals::RegionSettings& settings) {
  const auto scale = signals::Radiometry::make(settings.radiometry);
  if (!scale) return tl::unexpected(scale.error());
  const auto set = [&](const char* key, std::optional<double> value, auto& counts) -> Result<> {
    if (!value) return {};
    const double there =
        scale->is_radiometric() ? scale->counts(*value) : pipeline::counts_of(*value, format);
    counts = there;
    return check_threshold(key, *value, there, *scale, settings.full_scale);
  };
  return set("hot_spot_threshold", region.hot_spot_threshold, settings.hot_spot_threshold)
      .and_then(
          [&] { return set("plume_threshold", region.plume_threshold, settings.plume_threshold); })
      .and_then([&] {
        return set("spatter_threshold", region.spatter_threshold, settings.spatter_threshold);
      });
}

/// Error: an alarm watches what never has a value.
Result<> check_alarms(const pipeline::RegionOfInterest& region, signals::Requires provided) {
  for (const signals::AlarmLimits& alarm : region.alarms) {
    const signals::SignalInfo& signal = signals::kSignals[alarm.signal];
    if (const auto missing = signals::first_missing(signal, provided)) {
      return fail("an alarm watches " + std::string(signal.name) + ", which has no value without " +
                  std::string(missing->text));
    }
  }
  return {};
}

}  // namespace

Result<pipeline::RegionPlan> plan_region(const pipeline::RegionOfInterest& region,
                                         const pipeline::ViewPlan& view,
                                         const signals::RadiometrySettings& radiometry,
                                         const signals::RegionScene& scene) {
  const hal::StreamFormat& format = view.sources[*view.measured].format;
  signals::RegionSettings settings;
  settings.outline = outline_of(region, scene.ball.centre);
  settings.width_set_point = region.width;
  settings.full_scale = pipeline::full_scale(format);
  settings.radiometry = radiometry;
  settings.radiometry.kelvin_per_count = format.kelvin_per_count;
  settings.radiometry.emissivity = region.emissivity;
  if (region.surroundings_temperature) {
    settings.radiometry.surroundings = *region.surroundings_temperature;
  }
  if (auto set = set_thresholds(region, format, settings); !set) return tl::unexpected(set.error());
  const auto assumed =
      signals::assumed_limits(view.projection, scene, settings.outline, format.frame_rate);
  settings.hot_spot_limits = {region.hot_spot_min_area.value_or(assumed.min_area),
                              region.hot_spot_max_speed.value_or(assumed.max_speed)};
  return check_alarms(region, signals::provided_by(settings, !scene.proxy.is_far())).map([&] {
    return pipeline::RegionPlan{region.name, region.view.index, std::move(settings)};
  });
}

}  // namespace orbwatch::app::daemon
