// SPDX-License-Identifier: Apache-2.0
#include "app/daemon/site/site_plan.h"

#include <algorithm>
#include <string>
#include <string_view>
#include <utility>

#include "app/daemon/site/region_plan.h"
#include "app/model/alignment/register_advice.h"
#include "app/pictures/colour_maps.h"
#include "app/pipeline/views/source_colours.h"

namespace orbwatch::app::daemon {
namespace {

/// Assumed scale of a thermal camera that is not connected yet, to check a recipe's temperatures.
constexpr double kAssumedKelvinPerCount = 0.04;

/// Index of a colour map, see SourceColours::map. The file's reader has checked the name.
std::size_t place_of(std::string_view colour_map) {
  const auto* const found = std::ranges::find(kColourMapNames, colour_map);
  return static_cast<std::size_t>(found - kColourMapNames.begin());
}

/// Fills a plan that has its scene and formats.
class Planner {
 public:
  Planner(const files::Resolved& site, SitePlan& plan) : site_(site), plan_(plan) {}

  Result<> run() {
    for (const pipeline::ViewSettings& view : site_.site.views) {
      if (auto planned = add_display_view(view); !planned) return planned;
    }
    for (std::size_t i = 0; i < site_.recipes.size(); ++i) {
      auto recipe = plan_recipe(i);
      if (!recipe) return tl::unexpected(in_recipe(site_, i, recipe.error()));
      plan_.recipes.push_back(std::move(*recipe));
    }
    return {};
  }

 private:
  /// A ball's picture by its own camera alone is copied: where that sees the scene from the ball,
  /// one part may hide another that the ball's centre sees.
  Result<> add_display_view(const pipeline::ViewSettings& view) {
    auto planned = plan_view(view, site_.rig);
    if (!planned) return tl::unexpected(planned.error());
    plan_.balls.push_back(view.kind == optics::ViewKind::Ball
                              ? std::make_shared<const optics::ViewProjection>(planned->projection)
                              : nullptr);
    if (is_own_picture(view)) {
      optics::Rig rig = site_.rig;
      rig.scene = {};
      planned = plan_view(view, rig);
      if (!planned) return tl::unexpected(planned.error());
    }
    plan_.views.push_back(std::move(*planned));
    return {};
  }

  bool is_registered(const pipeline::SourceSettings& source) const {
    return site_.rig_camera(source.camera.index).is_registered;
  }

  /// The sources of a view without those that are not registered, which would put things in wrong
  /// places. One alone is shown as it is.
  std::vector<pipeline::SourceSettings> shown_together(const pipeline::ViewSettings& view) const {
    std::vector<pipeline::SourceSettings> shown;
    for (const pipeline::SourceSettings& source : view.sources) {
      if (is_registered(source)) shown.push_back(source);
    }
    if (shown.empty()) shown.push_back(view.sources.front());
    return shown;
  }

  /// Nothing is measured at a place that is not known.
  Result<> check_measured(const pipeline::MeasuredViewSettings& view) const {
    const pipeline::SourceSettings& measured = view.sources[view.measured.index];
    if (is_registered(measured)) return {};
    return fail("view " + view.name + ": camera " + measured.camera.name +
                ", which measures it, is not registered; " + std::string(kRegisterAdvice) +
                ", or name another camera");
  }

  /// Error: the rig makes the view impossible.
  Result<pipeline::ViewPlan> plan_view(const pipeline::ViewSettings& view,
                                       const optics::Rig& rig) const {
    std::vector<pipeline::ViewSource> sources;
    for (const pipeline::SourceSettings& source : shown_together(view)) {
      const std::size_t camera = source.camera.index;
      auto ball = optics::ball_projection(rig, rig.cameras[site_.rig_cameras[camera]]);
      if (!ball) return tl::unexpected(ball.error());
      const hal::StreamFormat& format = plan_.formats[camera];
      const auto range = range_of(source);
      sources.push_back(
          {camera,
           format,
           std::move(*ball),
           source.weight,
           pipeline::make_colour_map(colour_map_table(source.colour_map), range, format),
           source.sharpness,
           {place_of(source.colour_map), range}});
    }
    auto projection = optics::ViewProjection::make(view.spec(), sources.front().ball);
    if (!projection) return fail("view " + view.name + ": " + projection.error().message);
    return pipeline::ViewPlan{
        view.index,   view.name,          std::move(*projection), std::move(sources),
        view.combine, view.interpolation, std::nullopt,           0,
        view.match};
  }

  Result<pipeline::ViewPlan> plan_measured_view(const pipeline::MeasuredViewSettings& view) const {
    auto planned = check_measured(view).and_then([&] { return plan_view(view, site_.rig); });
    if (!planned) return planned;
    const std::size_t camera = view.sources[view.measured.index].camera.index;
    planned->measured = static_cast<std::size_t>(
        std::ranges::find(planned->sources, camera, &pipeline::ViewSource::camera) -
        planned->sources.begin());
    return planned;
  }

  Result<pipeline::RecipePlan> plan_recipe(std::size_t index) const {
    const pipeline::Recipe& recipe = site_.recipes[index];
    pipeline::RecipePlan plan;
    plan.number = site_.site.recipes[index].number;
    for (const pipeline::MeasuredViewSettings& view : recipe.views) {
      auto planned = plan_measured_view(view);
      if (!planned) return tl::unexpected(planned.error());
      plan.views.push_back(std::move(*planned));
    }
    for (const pipeline::RegionOfInterest& region : recipe.regions) {
      const pipeline::ViewPlan& view = plan.views[region.view.index];
      const std::size_t camera = view.sources[*view.measured].camera;
      auto planned = plan_region(region, view, site_.site.cameras[camera].radiometry, plan_.scene);
      if (!planned) return fail("region " + region.name + ": " + planned.error().message);
      plan.regions.push_back(std::move(*planned));
      plan.alarms.insert(plan.alarms.end(), region.alarms.begin(), region.alarms.end());
    }
    plan.controls.assign(recipe.controls.begin(), recipe.controls.end());
    plan.settle_frames = recipe.settle_frames;
    plan.process_active = recipe.process_active;
    plan.process_input = recipe.process_input.index;
    return plan;
  }

  const files::Resolved& site_;
  SitePlan& plan_;
};

}  // namespace

hal::StreamFormat expected_format(const files::Resolved& site, std::size_t camera) {
  const files::CameraSettings& settings = site.site.cameras[camera];
  hal::StreamFormat format;
  const signals::RadiometrySettings& radiometry = settings.radiometry;
  format.format = radiometry.is_radiometric() ? PixelFormat::Y16 : PixelFormat::Grey;
  format.kelvin_per_count = radiometry.kelvin_per_count > 0 ? radiometry.kelvin_per_count
                            : radiometry.states_scale       ? kAssumedKelvinPerCount
                                                            : 0;
  format.kelvin_offset = radiometry.kelvin_offset;
  format.width = site.rig_camera(camera).width;
  format.height = site.rig_camera(camera).height;
  format.frame_rate = settings.stream.frame_rate;
  return format;
}

std::vector<hal::StreamFormat> expected_formats(const files::Resolved& site) {
  std::vector<hal::StreamFormat> formats;
  for (std::size_t i = 0; i < site.site.cameras.size(); ++i) {
    formats.push_back(expected_format(site, i));
  }
  return formats;
}

Result<SitePlan> SitePlan::make(const files::Resolved& site,
                                std::vector<hal::StreamFormat> formats) {
  auto proxy = optics::SceneProxy::make(site.rig.scene, site.rig.ball);
  if (!proxy) return tl::unexpected(proxy.error());
  SitePlan plan;
  plan.scene = {site.rig.ball, std::move(*proxy)};
  plan.formats = std::move(formats);
  return Planner(site, plan).run().map([&] { return std::move(plan); });
}

Error in_recipe(const files::Resolved& site, std::size_t recipe, const Error& error) {
  return {site.site.recipes[recipe].file.path.string() + ": " + error.message};
}

}  // namespace orbwatch::app::daemon
