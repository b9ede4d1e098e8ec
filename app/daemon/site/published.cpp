// SPDX-License-Identifier: Apache-2.0
#include "app/daemon/site/published.h"

#include <cstddef>
#include <filesystem>
#include <memory>
#include <string>
#include <system_error>

#include "app/files/lexical_path.h"

namespace orbwatch::app::daemon {
namespace {

PublishedSource published(const files::Resolved& site, const pipeline::SourceSettings& source) {
  const files::CameraSettings& camera = site.site.cameras[source.camera.index];
  return {camera.name, source.colour_map, range_of(source), camera.radiometry.is_radiometric()};
}

/// Offers a measured view.
PublishedView published(const files::Resolved& site, const pipeline::ViewSettings& view) {
  PublishedView published_view;
  published_view.encoding = view.encoding;
  published_view.spec = view.spec();
  for (const pipeline::SourceSettings& source : view.sources) {
    published_view.sources.push_back(published(site, source));
  }
  return published_view;
}

PublishedView published_display(const files::Resolved& site, const pipeline::ViewSettings& view) {
  PublishedView display = published(site, view);
  display.measured = false;
  display.is_own_picture = is_own_picture(view);
  display.mixes = view.combine != pipeline::Combine::Switch && view.sources.size() > 1;
  return display;
}

std::shared_ptr<const optics::ViewProjection> shared(const pipeline::ViewPlan& view) {
  return std::make_shared<const optics::ViewProjection>(view.projection);
}

/// Path below the configuration's folder, by which its files name each other.
std::string recorded_name(const std::filesystem::path& file, const std::filesystem::path& folder) {
  const std::filesystem::path place = file.lexically_normal(), base = folder.lexically_normal();
  if (files::is_lexically_below(place, base)) return place.lexically_relative(base).string();
  std::error_code none;  // a file that was read has an absolute path
  const auto absolute = std::filesystem::absolute(file, none).lexically_normal();
  return (std::filesystem::path(kRecordedOutside) / absolute.relative_path()).string();
}

MeasuredRecipe measured(const pipeline::Recipe& stated, const pipeline::RecipePlan& plan) {
  MeasuredRecipe recipe{plan.number, stated.name, {}, {}, plan.alarms};
  for (const pipeline::ViewPlan& view : plan.views)
    recipe.views.push_back({view.name, shared(view)});
  for (std::size_t i = 0; i < plan.regions.size(); ++i) {
    const pipeline::RegionPlan& region = plan.regions[i];
    recipe.regions.push_back({region.name, region.view, stated.regions[i].directions,
                              stated.regions[i].points, region.settings.outline});
  }
  return recipe;
}

}  // namespace

std::vector<PublishedView> published_views(const files::Resolved& site, const SitePlan& plan) {
  std::vector<PublishedView> views(site.names.views.size());
  for (std::size_t i = 0; i < site.site.views.size(); ++i) {
    const pipeline::ViewSettings& view = site.site.views[i];
    views[view.index] = published_display(site, view);
    views[view.index].ball = plan.balls[i];
  }
  for (std::size_t i = 0; i < site.recipes.size(); ++i) {
    for (std::size_t k = 0; k < site.recipes[i].views.size(); ++k) {
      const pipeline::ViewSettings& view = site.recipes[i].views[k];
      views[view.index] = published(site, view);
      const bool is_ball = view.kind == optics::ViewKind::Ball;
      views[view.index].ball = is_ball ? shared(plan.recipes[i].views[k]) : nullptr;
    }
  }
  return views;
}

std::vector<PublishedCamera> published_cameras(const files::Resolved& site) {
  std::vector<PublishedCamera> cameras;
  for (std::size_t i = 0; i < site.site.cameras.size(); ++i) {
    cameras.push_back({site.site.cameras[i].encoding, site.rig_camera(i).intrinsics});
  }
  return cameras;
}

std::vector<std::shared_ptr<const optics::ViewProjection>> camera_balls(
    const files::Resolved& site) {
  std::vector<std::shared_ptr<const optics::ViewProjection>> balls(site.site.cameras.size());
  for (std::size_t i = 0; i < balls.size(); ++i) {
    const optics::RigCamera& camera = site.rig_camera(i);
    if (!camera.is_registered) continue;
    const auto view = optics::ball_projection(site.rig, camera).and_then([&](const auto& ball) {
      return optics::ViewProjection::whole_picture(ball, camera.width, camera.height);
    });
    if (view) balls[i] = std::make_shared<const optics::ViewProjection>(*view);
  }
  return balls;
}

RecordedTexts recorded_texts(const files::Resolved& site, const Program& program) {
  RecordedTexts recorded{{}, program.versions};
  const std::filesystem::path folder = site.file.parent_path();
  for (const auto& [path, text] : site.texts) recorded.files[recorded_name(path, folder)] = text;
  for (const auto& [path, text] : site.calibration) {
    if (!text.empty()) recorded.files[std::string(kRecordedCalibration)] = text;
  }
  return recorded;
}

std::vector<MeasuredRecipe> measured_recipes(const files::Resolved& site, const SitePlan& plan) {
  std::vector<MeasuredRecipe> recipes;
  for (std::size_t i = 0; i < plan.recipes.size(); ++i) {
    recipes.push_back(measured(site.recipes[i], plan.recipes[i]));
  }
  return recipes;
}

}  // namespace orbwatch::app::daemon
