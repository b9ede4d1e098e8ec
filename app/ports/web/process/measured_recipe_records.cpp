// SPDX-License-Identifier: Apache-2.0
#include "app/ports/web/process/measured_recipe_records.h"

#include "proc/optics/rotation.h"
#include "proc/signals/spherical_polygon.h"

namespace orbwatch::app::web {
namespace {

using optics::Vec3;

/// Frame around the view's field of view.
SentLines frame_of(const optics::ViewProjection& view) {
  const double right = view.width() - 0.5, bottom = view.height() - 0.5;
  return {{{-0.5, -0.5}, {right, -0.5}, {right, bottom}, {-0.5, bottom}, {-0.5, -0.5}}};
}

/// Outline in the view; regions with an invalid outline do not run.
SentLines lines_of(const optics::ViewProjection& view, const std::vector<Vec3>& outline) {
  if (outline.empty()) return frame_of(view);
  const auto polygon = signals::SphericalPolygon::make(outline);
  return polygon ? polygon->lines_in(view) : SentLines{};
}

SentRegion sent_region(const MeasuredRecipe& recipe, const MeasuredRecipe::Region& region) {
  const MeasuredRecipe::View& view = recipe.views[region.view];
  const optics::ViewProjection& projection = *view.projection;
  SentRegion sent{region.name, view.name, "whole_view", {}, lines_of(projection, region.outline)};
  const auto add_corners = [&](const char* kind, const auto& corners) {
    if (!corners.empty()) sent.kind = kind;
    for (std::size_t i = 0; i < corners.size(); ++i) {
      sent.corners.push_back({{corners[i].begin(), corners[i].end()},
                              projection.pixel(optics::normalized(region.outline[i]))});
    }
  };
  add_corners("directions", region.directions);
  add_corners("points", region.points);
  return sent;
}

}  // namespace

RecipeAnswer recipe_answer(const MeasuredRecipe& recipe) {
  RecipeAnswer answer{recipe.number, recipe.name, {}, {}, {}, {}};
  for (const auto& [name, view] : recipe.views) {
    answer.views.push_back({name, view->width(), view->height()});
  }
  for (const auto& region : recipe.regions) answer.regions.push_back(sent_region(recipe, region));
  for (const signals::AlarmLimits& limits : recipe.alarms) {
    const signals::SignalInfo& signal = signals::kSignals[limits.signal];
    answer.alarms.push_back({answer.alarms.size() + 1, recipe.regions[limits.region].name,
                             signal.name, signal.title, signal.unit, limits});
  }
  return answer;
}

Result<PolygonAnswer> polygon_answer(const optics::ViewProjection& view,
                                     const signals::RegionScene& scene,
                                     const std::vector<optics::Vec2>& pixels) {
  PolygonAnswer answer;
  std::vector<Vec3> outline;
  for (const optics::Vec2& pixel : pixels) {
    const auto direction = view.direction(pixel.u, pixel.v);
    if (!direction) return fail("the view shows nothing at one of these pixels");
    outline.push_back(*direction);
    const optics::YawPitchRoll angles = optics::yaw_pitch(*direction);
    SentPolygonCorner& corner = answer.corners.emplace_back();
    corner.direction = {angles.yaw, angles.pitch};
    const double closeness = scene.proxy.hit(*direction).closeness;
    if (closeness > 0) {
      corner.point = scene.ball.centre + *direction * (scene.ball.radius / closeness);
    }
  }
  return signals::SphericalPolygon::make(outline).map([&](const auto& polygon) {
    answer.lines = polygon.lines_in(view);
    return std::move(answer);
  });
}

}  // namespace orbwatch::app::web
