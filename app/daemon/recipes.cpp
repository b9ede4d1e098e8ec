#include "app/daemon/recipes.h"

#include <algorithm>
#include <optional>
#include <string>
#include <string_view>
#include <utility>

#include "app/config/alarm_settings.h"
#include "app/daemon/by_name.h"
#include "app/daemon/view_plans.h"
#include "proc/optics/rotation.h"

namespace orbwatch::app {
namespace {

using Formats = std::vector<hal::StreamFormat>;

signals::RadiometrySettings radiometry(const CameraSettings& camera,
                                       const RegionOfInterest& region) {
  signals::RadiometrySettings radiometry;
  radiometry.kelvin_per_count = camera.kelvin_per_count;
  radiometry.emissivity = region.emissivity;
  if (region.surroundings_temperature) radiometry.surroundings = *region.surroundings_temperature;
  if (camera.radiometry) {
    radiometry.wavelength = camera.radiometry->wavelength;
    radiometry.reflectivity = camera.radiometry->ball_reflectivity;
    radiometry.ball_temperature = camera.radiometry->ball_temperature;
  }
  return radiometry;
}

/// From the ball's centre to the corners.
std::vector<optics::Vec3> outline(const RegionOfInterest& region, const optics::Ball& ball) {
  std::vector<optics::Vec3> corners;
  for (const auto& [yaw, pitch] : region.directions) {
    corners.push_back(optics::rotation({yaw, pitch, 0}) * optics::Vec3{0, 1, 0});
  }
  for (const auto& [x, y, z] : region.points) {
    corners.push_back(optics::Vec3{x, y, z} - ball.centre);
  }
  return corners;
}

Result<signals::RegionSettings> region_settings(const RegionOfInterest& region,
                                                const CameraSettings& camera,
                                                const hal::StreamFormat& format,
                                                const optics::Ball& ball) {
  signals::RegionSettings settings;
  settings.outline = outline(region, ball);
  settings.width_set_point = region.width;
  settings.full_scale = (1 << info(format.format).bits) - 1;
  settings.radiometry = radiometry(camera, region);
  const auto scale = signals::Radiometry::make(settings.radiometry);
  if (!scale) return tl::unexpected(scale.error());
  const auto threshold = [&](double value) {
    return scale->is_radiometric() ? scale->counts(value) : counts(value, camera, format);
  };
  settings.hot_spot_threshold = threshold(region.hot_spot_threshold);
  if (region.plume_threshold) settings.plume_threshold = threshold(*region.plume_threshold);
  if (region.spatter_threshold) settings.spatter_threshold = threshold(*region.spatter_threshold);
  return settings;
}

/// What a signal never has a value without, if it is missing.
std::optional<std::string_view> missing_for(const signals::SignalInfo& signal,
                                            const RegionOfInterest& region, bool has_scene,
                                            bool is_radiometric) {
  const auto is = [&signal](std::string_view part) {
    return signal.name.find(part) != std::string_view::npos;
  };
  if (is("spatter") && !region.spatter_threshold) return "the region's spatter_threshold";
  if (is("plume") && !region.plume_threshold) return "the region's plume_threshold";
  if (is("width_error") && !region.width) return "the region's width";
  if ((is("temperature") || is("cooling")) && !is_radiometric) {
    return "a measured camera with kelvin_per_count";
  }
  if (signal.unit.starts_with("mm") && !has_scene) return "the rig's scene";
  return std::nullopt;
}

Result<> plan_regions(const Configuration& configuration, const Recipe& recipe,
                      const Formats& formats, bool has_scene, RecipePlan& plan) {
  for (const RegionOfInterest& region : recipe.regions) {
    const std::size_t view = index_of(recipe.views, region.view);
    const std::size_t camera = index_of(configuration.cameras, recipe.views[view].measured);
    auto settings = region_settings(region, configuration.cameras[camera], formats[camera],
                                    configuration.rig.ball);
    if (!settings) return fail("region " + region.name + ": " + settings.error().message);
    for (const AlarmSettings& alarm : region.alarms) {
      auto limits = alarm_limits(alarm, plan.regions.size());
      if (!limits) return tl::unexpected(limits.error());
      const auto missing = missing_for(signals::kSignals[limits->signal], region, has_scene,
                                       settings->radiometry.kelvin_per_count > 0);
      if (missing) {
        return fail("region " + region.name + ": an alarm watches " + alarm.signal +
                    ", which has no value without " + std::string(*missing));
      }
      plan.alarms.push_back(*limits);
    }
    plan.regions.push_back({region.name, view, std::move(*settings)});
  }
  return {};
}

/// Its place among the lines that are process inputs.
std::size_t process_input(const Configuration& configuration, const std::string& name) {
  std::size_t place = 0;
  for (const LineSettings& line : configuration.lines) {
    if (line.name == name) break;
    place += line.use == LineUse::ProcessInput ? 1 : 0;
  }
  return place;
}

Result<RecipePlan> plan_recipe(const Configuration& configuration, const RecipeSettings& settings,
                               const Formats& formats, bool has_scene) {
  const Recipe& recipe = settings.recipe;
  const auto names = view_names(configuration);
  RecipePlan plan;
  plan.number = static_cast<std::uint16_t>(settings.number);
  for (const MeasuredViewSettings& view : recipe.views) {
    const auto index =
        static_cast<std::size_t>(std::ranges::find(names, view.name) - names.begin());
    auto planned = plan_view(configuration, view, index, formats, view.measured);
    if (!planned) return tl::unexpected(planned.error());
    plan.views.push_back(std::move(*planned));
  }
  if (auto done = plan_regions(configuration, recipe, formats, has_scene, plan); !done) {
    return tl::unexpected(done.error());
  }
  for (const CameraControlSettings& control : recipe.controls) {
    plan.controls.push_back(
        {index_of(configuration.cameras, control.camera), control.name, control.value});
  }
  plan.settle_frames = recipe.settle_frames;
  plan.process_active = recipe.process_active;
  plan.process_input = process_input(configuration, recipe.process_input);
  return plan;
}

}  // namespace

Result<std::vector<std::unique_ptr<CompiledRecipe>>> compile_recipes(
    const Configuration& configuration, const Formats& formats) {
  const optics::Rig& rig = configuration.rig;
  const auto proxy = optics::SceneProxy::make(rig.scene, rig.ball);
  if (!proxy) return tl::unexpected(proxy.error());
  std::vector<std::unique_ptr<CompiledRecipe>> recipes;
  for (const RecipeSettings& settings : configuration.recipes) {
    auto recipe = plan_recipe(configuration, settings, formats, !proxy->is_far())
                      .and_then([&](const RecipePlan& plan) {
                        return CompiledRecipe::make(plan, {rig.ball, *proxy});
                      });
    if (!recipe) return fail(settings.file.string() + ": " + recipe.error().message);
    recipes.push_back(std::move(*recipe));
  }
  return recipes;
}

}  // namespace orbwatch::app
