#include "app/daemon/build.h"

#include <algorithm>
#include <array>
#include <cstddef>
#include <iomanip>
#include <optional>
#include <sstream>
#include <string>
#include <string_view>
#include <tuple>
#include <utility>

#include "app/daemon/view_memory.h"
#include "app/pictures/colour_maps.h"
#include "app/pipeline/views/source_colours.h"
#include "app/ports/dds/security/participant_security.h"
#include "app/ports/web/tls/server_certificate.h"
#include "hal/host.h"
#include "hal/thread/scheduling.h"
#include "proc/optics/rotation.h"
#include "proc/signals/hot_spot/assumed_limits.h"

namespace orbwatch::app {
namespace {

/// Of a camera that says it, until it is there: the temperatures of a recipe are checked with it.
constexpr double kAssumedKelvinPerCount = 0.04;

/// As SourceColours::map has it. The file's reader knows the name.
std::size_t place_of(std::string_view colour_map) {
  const auto* const found = std::ranges::find(kColourMapNames, colour_map);
  return static_cast<std::size_t>(found - kColourMapNames.begin());
}

/// Empty: the region states all, or nothing is assumed, for lack of a scene.
std::string assumption_text(const RegionOfInterest& stated, const RegionPlan& region) {
  const signals::HotSpotLimits& limits = region.settings.hot_spot_limits;
  if (!limits.need_surface()) return "";
  std::ostringstream text;
  text << std::fixed << std::setprecision(1);
  if (!stated.hot_spot_min_area) text << " hot_spot_min_area = " << limits.min_area << " mm2";
  if (!stated.hot_spot_max_speed) {
    text << (text.tellp() > 0 ? " and" : "") << " hot_spot_max_speed = " << limits.max_speed
         << " mm/s";
  }
  if (text.tellp() == 0) return "";
  return "region " + stated.name + ": assumes" + text.str() + "; state what is true of the process";
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

/// Plans views and recipes of a site for cameras of these formats.
class Builder {
 public:
  Builder(const Resolved& site, const std::vector<hal::StreamFormat>& formats,
          optics::SceneProxy proxy)
      : site_(site), formats_(formats), scene_{site.rig.ball, std::move(proxy)} {}

  /// Error: the rig makes the view impossible.
  Result<ViewPlan> plan_view(const ViewSettings& view) const { return plan_view(view, site_.rig); }

  /// As plan_view(). A ball's picture by its own camera alone is copied: where that sees the scene
  /// from the ball, one part may hide another that the ball's centre sees.
  Result<ViewPlan> plan_display_view(const ViewSettings& view) const {
    if (view.kind != optics::ViewKind::Ball || view.sources.size() != 1) return plan_view(view);
    optics::Rig rig = site_.rig;
    rig.scene = {};
    return plan_view(view, rig);
  }

  /// Errors name the recipe's file.
  Result<std::unique_ptr<CompiledRecipe>> compile(std::size_t recipe) const {
    return named(recipe, plan_recipe(recipe).and_then([this](RecipePlan plan) {
      return CompiledRecipe::make(std::move(plan), scene_);
    }));
  }

  /// Errors: as compile().
  Result<MeasuredRecipe> measured(std::size_t recipe) const {
    return named(recipe, plan_recipe(recipe).map([&](const RecipePlan& plan) {
      const Recipe& stated = site_.recipes[recipe];
      MeasuredRecipe measured{plan.number, stated.name, {}, {}, plan.alarms};
      for (const ViewPlan& view : plan.views) {
        measured.views.push_back(
            {view.name, std::make_shared<const optics::ViewProjection>(view.projection)});
      }
      for (std::size_t i = 0; i < plan.regions.size(); ++i) {
        const RegionPlan& region = plan.regions[i];
        measured.regions.push_back({region.name, region.view, stated.regions[i].directions,
                                    stated.regions[i].points, region.settings.outline});
      }
      return measured;
    }));
  }

  /// Limits of hot spots that a recipe leaves open, a line for each region. None: it has an error.
  std::vector<std::string> assumptions(std::size_t recipe) const {
    std::vector<std::string> lines;
    const auto plan = plan_recipe(recipe);
    for (std::size_t i = 0; plan && i < plan->regions.size(); ++i) {
      const auto text = assumption_text(site_.recipes[recipe].regions[i], plan->regions[i]);
      if (!text.empty()) lines.push_back(file_of(recipe) + ": " + text);
    }
    return lines;
  }

  /// Errors: as compile().
  Result<> check(std::size_t recipe) const {
    return named(recipe, plan_recipe(recipe).and_then([this](const RecipePlan& plan) {
      return CompiledRecipe::check(plan, scene_);
    }));
  }

 private:
  bool is_registered(const SourceSettings& source) const {
    return site_.rig_camera(source.camera.index).is_registered;
  }

  /// The sources of a view but those of which nobody knows where they look: they would put things
  /// in wrong places. One alone is shown as it is.
  std::vector<SourceSettings> shown_together(const ViewSettings& view) const {
    std::vector<SourceSettings> shown;
    for (const SourceSettings& source : view.sources) {
      if (is_registered(source)) shown.push_back(source);
    }
    if (shown.empty()) shown.push_back(view.sources.front());
    return shown;
  }

  /// Nothing is measured at a place that is not known.
  Result<> check_measured(const MeasuredViewSettings& view) const {
    const SourceSettings& measured = view.sources[view.measured.index];
    if (is_registered(measured)) return {};
    return fail("view " + view.name + ": camera " + measured.camera.name +
                ", which measures it, is not registered; register it (`orbwatch register`, or the "
                "commands register_camera and accept_alignment), or name another camera");
  }

  Result<ViewPlan> plan_view(const ViewSettings& view, const optics::Rig& rig) const {
    std::vector<ViewSource> sources;
    for (const SourceSettings& source : shown_together(view)) {
      const std::size_t camera = source.camera.index;
      auto ball = optics::ball_projection(rig, rig.cameras[site_.rig_cameras[camera]]);
      if (!ball) return tl::unexpected(ball.error());
      const auto range = range_of(source);
      sources.push_back(
          {camera,
           formats_[camera],
           std::move(*ball),
           source.weight,
           make_colour_map(colour_map_table(source.colour_map), range, formats_[camera]),
           source.sharpness,
           {place_of(source.colour_map), range}});
    }
    auto projection = optics::ViewProjection::make(view.spec(), sources.front().ball);
    if (!projection) return fail("view " + view.name + ": " + projection.error().message);
    return ViewPlan{view.index,   view.name,          std::move(*projection), std::move(sources),
                    view.combine, view.interpolation, std::nullopt,           0,
                    view.match};
  }

  template <class T>
  Result<T> named(std::size_t recipe, Result<T> result) const {
    if (result) return result;
    return fail(file_of(recipe) + ": " + result.error().message);
  }

  std::string file_of(std::size_t recipe) const {
    return site_.site.recipes[recipe].file.path.string();
  }

  Result<RecipePlan> plan_recipe(std::size_t index) const {
    const Recipe& recipe = site_.recipes[index];
    RecipePlan plan;
    plan.number = site_.site.recipes[index].number;
    for (const MeasuredViewSettings& view : recipe.views) {
      auto planned = check_measured(view).and_then([&] { return plan_view(view); });
      if (!planned) return tl::unexpected(planned.error());
      const std::size_t camera = view.sources[view.measured.index].camera.index;
      planned->measured = static_cast<std::size_t>(
          std::ranges::find(planned->sources, camera, &ViewSource::camera) -
          planned->sources.begin());
      plan.views.push_back(std::move(*planned));
    }
    for (const RegionOfInterest& region : recipe.regions) {
      const auto& measured = recipe.views[region.view.index];
      const std::size_t camera = measured.sources[measured.measured.index].camera.index;
      if (auto planned = plan_region(region, camera, plan); !planned) {
        return fail("region " + region.name + ": " + planned.error().message);
      }
    }
    plan.controls.assign(recipe.controls.begin(), recipe.controls.end());
    plan.settle_frames = recipe.settle_frames;
    plan.process_active = recipe.process_active;
    plan.process_input = recipe.process_input.index;
    return plan;
  }

  /// From the ball's centre to the corners.
  std::vector<optics::Vec3> outline(const RegionOfInterest& region) const {
    std::vector<optics::Vec3> corners;
    for (const auto& [yaw, pitch] : region.directions) {
      corners.push_back(optics::rotation({yaw, pitch, 0}) * optics::Vec3{0, 1, 0});
    }
    for (const auto& [x, y, z] : region.points) {
      corners.push_back(optics::Vec3{x, y, z} - scene_.ball.centre);
    }
    return corners;
  }

  Result<signals::RegionSettings> region_settings(const RegionOfInterest& region,
                                                  std::size_t camera) const {
    const CameraSettings& measured = site_.site.cameras[camera];
    const hal::StreamFormat& format = formats_[camera];
    signals::RegionSettings settings;
    settings.outline = outline(region);
    settings.width_set_point = region.width;
    settings.full_scale = full_scale(format);
    settings.radiometry = measured.radiometry;
    settings.radiometry.kelvin_per_count = format.kelvin_per_count;
    settings.radiometry.emissivity = region.emissivity;
    if (region.surroundings_temperature) {
      settings.radiometry.surroundings = *region.surroundings_temperature;
    }
    const auto scale = signals::Radiometry::make(settings.radiometry);
    if (!scale) return tl::unexpected(scale.error());
    const auto in_counts = [&](const char* key, std::optional<double> value,
                               auto& counts) -> Result<> {
      if (!value) return {};
      const double there =
          scale->is_radiometric() ? scale->counts(*value) : counts_of(*value, format);
      counts = there;
      return check_threshold(key, *value, there, *scale, settings.full_scale);
    };
    return in_counts("hot_spot_threshold", region.hot_spot_threshold, settings.hot_spot_threshold)
        .and_then([&] {
          return in_counts("plume_threshold", region.plume_threshold, settings.plume_threshold);
        })
        .and_then([&] {
          return in_counts("spatter_threshold", region.spatter_threshold,
                           settings.spatter_threshold);
        })
        .map([&] { return settings; });
  }

  Result<> plan_region(const RegionOfInterest& region, std::size_t camera, RecipePlan& plan) const {
    auto settings = region_settings(region, camera);
    if (!settings) return tl::unexpected(settings.error());
    const auto assumed = signals::assumed_limits(plan.views[region.view.index].projection, scene_,
                                                 settings->outline, formats_[camera].frame_rate);
    settings->hot_spot_limits = {region.hot_spot_min_area.value_or(assumed.min_area),
                                 region.hot_spot_max_speed.value_or(assumed.max_speed)};
    const auto provided = signals::provided_by(*settings, !scene_.proxy.is_far());
    for (const signals::AlarmLimits& alarm : region.alarms) {
      const signals::SignalInfo& signal = signals::kSignals[alarm.signal];
      if (const auto missing = signals::first_missing(signal, provided)) {
        return fail("an alarm watches " + std::string(signal.name) +
                    ", which has no value without " + std::string(missing->text));
      }
      plan.alarms.push_back(alarm);
    }
    plan.regions.push_back({region.name, region.view.index, std::move(*settings)});
    return {};
  }

  const Resolved& site_;
  const std::vector<hal::StreamFormat>& formats_;
  const signals::RegionScene scene_;
};

bool uses(const std::vector<ViewSource>& sources, std::size_t camera) {
  return std::ranges::find(sources, camera, &ViewSource::camera) != sources.end();
}

bool uses(const Recipe& recipe, std::size_t camera) {
  return std::ranges::any_of(recipe.views, [camera](const MeasuredViewSettings& view) {
    return std::ranges::any_of(view.sources, [camera](const SourceSettings& source) {
      return source.camera.index == camera;
    });
  });
}

std::vector<hal::StreamFormat> expected_formats(const Resolved& site) {
  std::vector<hal::StreamFormat> formats;
  for (std::size_t i = 0; i < site.site.cameras.size(); ++i) {
    formats.push_back(expected_format(site, i));
  }
  return formats;
}

}  // namespace

hal::StreamFormat expected_format(const Resolved& site, std::size_t camera) {
  const CameraSettings& settings = site.site.cameras[camera];
  hal::StreamFormat format;
  const signals::RadiometrySettings& radiometry = settings.radiometry;
  format.format = radiometry.is_radiometric() ? PixelFormat::Y16 : PixelFormat::Grey;
  format.kelvin_per_count = radiometry.kelvin_per_count > 0 ? radiometry.kelvin_per_count
                            : radiometry.says_scale         ? kAssumedKelvinPerCount
                                                            : 0;
  format.kelvin_offset = radiometry.kelvin_offset;
  format.width = site.rig_camera(camera).width;
  format.height = site.rig_camera(camera).height;
  format.frame_rate = settings.stream.frame_rate;
  return format;
}

Result<PipelinePlan> build(const Resolved& site, std::vector<hal::StreamFormat> formats) {
  auto proxy = optics::SceneProxy::make(site.rig.scene, site.rig.ball);
  if (!proxy) return tl::unexpected(proxy.error());
  const Builder builder(site, formats, std::move(*proxy));
  PipelinePlan plan;
  static_cast<PipelineSettings&>(plan) = site.site.pipeline;
  for (const ViewSettings& settings : site.site.views) {
    auto view = builder.plan_display_view(settings);
    if (!view) return tl::unexpected(view.error());
    plan.views.push_back(std::move(*view));
  }
  for (std::size_t i = 0; i < site.recipes.size(); ++i) {
    auto recipe = builder.compile(i);
    if (!recipe) return tl::unexpected(recipe.error());
    plan.recipes.push_back(std::move(*recipe));
  }
  for (const std::string_view map : kColourMapNames) {
    plan.colour_maps.push_back(colour_map_table(map));
  }
  plan.reserved_cores = site.site.threads.cores.size();
  plan.view_count = site.names.views.size();
  plan.configuration_checksum = site.checksum;
  for (std::size_t i = 0; i < site.site.cameras.size(); ++i) {
    plan.sync.policies[i] = site.site.cameras[i].sync;
  }
  plan.camera_names = site.names.cameras;
  plan.formats = std::move(formats);
  return plan;
}

Result<Recompiled> rebuild(const Resolved& site, std::vector<hal::StreamFormat> formats,
                           std::size_t camera) {
  auto proxy = optics::SceneProxy::make(site.rig.scene, site.rig.ball);
  if (!proxy) return tl::unexpected(proxy.error());
  const Builder builder(site, formats, std::move(*proxy));
  Recompiled recompiled;
  for (std::size_t i = 0; i < site.site.views.size(); ++i) {
    auto view = builder.plan_display_view(site.site.views[i]);
    if (!view) return tl::unexpected(view.error());
    if (uses(view->sources, camera)) recompiled.sources[i] = std::move(view->sources);
  }
  recompiled.recipes.resize(site.recipes.size());
  for (std::size_t i = 0; i < site.recipes.size(); ++i) {
    if (!uses(site.recipes[i], camera)) continue;
    auto recipe = builder.compile(i);
    if (!recipe) return tl::unexpected(recipe.error());
    recompiled.recipes[i] = std::move(*recipe);
  }
  recompiled.formats = std::move(formats);
  return recompiled;
}

Result<std::vector<MeasuredRecipe>> measured_recipes(const Resolved& site) {
  const auto formats = expected_formats(site);
  auto proxy = optics::SceneProxy::make(site.rig.scene, site.rig.ball);
  if (!proxy) return tl::unexpected(proxy.error());
  const Builder builder(site, formats, std::move(*proxy));
  std::vector<MeasuredRecipe> recipes;
  for (std::size_t i = 0; i < site.recipes.size(); ++i) {
    auto recipe = builder.measured(i);
    if (!recipe) return tl::unexpected(recipe.error());
    recipes.push_back(std::move(*recipe));
  }
  return recipes;
}

std::vector<std::string> assumptions(const Resolved& site) {
  std::vector<std::string> lines;
  for (std::size_t i = 0; i < site.site.cameras.size(); ++i) {
    if (site.rig_camera(i).is_registered) continue;
    lines.push_back(site.site.rig.path.string() + ": camera " + site.names.cameras[i] +
                    ": is not registered, and left out of merged and measured views; register it "
                    "(`orbwatch register`, or the commands register_camera and accept_alignment)");
  }
  const auto formats = expected_formats(site);
  auto proxy = optics::SceneProxy::make(site.rig.scene, site.rig.ball);
  if (!proxy) return lines;
  const Builder builder(site, formats, std::move(*proxy));
  for (std::size_t i = 0; i < site.recipes.size(); ++i) {
    for (std::string& line : builder.assumptions(i)) lines.push_back(std::move(line));
  }
  return lines;
}

Result<> check_keys(const Resolved& site, Dates dates) {
  const auto& dds = std::get<DdsSettings>(site.site.sinks);
  const auto& web = std::get<WebSettings>(site.site.sinks);
  const Result<> checked =
      dds.enabled && dds.security ? check_security(*dds.security, dds.domain, dates) : Result<>();
  if (!checked || !web.enabled || web.certificate.empty()) return checked;
  return web::named_certificate(web, now_for(dates)).map([](const auto&) {});
}

Result<> check_ports(const Resolved& site) {
  const auto& modbus = std::get<ModbusSettings>(site.site.sinks);
  const auto& web = std::get<WebSettings>(site.site.sinks);
  if (!modbus.enabled || !web.enabled || modbus.port == 0) return {};
  const auto meets = [&modbus](const std::string& address) {
    return address == modbus.address || hal::is_unspecified(address) ||
           hal::is_unspecified(modbus.address);
  };
  const bool is_http =
      web.port == modbus.port && std::ranges::any_of(http_addresses_of(web), meets);
  const bool is_https = https_port_of(web) == modbus.port && meets(web.address);
  if (!is_http && !is_https) return {};
  return fail(std::string("[web] ") + (is_http ? "port" : "https_port") +
              " and [modbus] port are both " + std::to_string(modbus.port) +
              "; give each a port of its own");
}

Result<> check_site(const Resolved& site, Dates dates) {
  if (auto fits = check_view_memory(site); !fits) return fits;
  const auto formats = expected_formats(site);
  auto proxy = optics::SceneProxy::make(site.rig.scene, site.rig.ball);
  if (!proxy) return tl::unexpected(proxy.error());
  const Builder builder(site, formats, std::move(*proxy));
  for (const ViewSettings& view : site.site.views) {
    if (const auto planned = builder.plan_display_view(view); !planned) {
      return tl::unexpected(planned.error());
    }
  }
  for (std::size_t i = 0; i < site.recipes.size(); ++i) {
    if (const auto checked = builder.check(i); !checked) return checked;
  }
  return hal::check(site.site.threads).and_then([&] { return check_ports(site); }).and_then([&] {
    return check_keys(site, dates);
  });
}

}  // namespace orbwatch::app
