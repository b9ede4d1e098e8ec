// SPDX-License-Identifier: Apache-2.0
#include "app/ports/web/process/recipe_text.h"

#include <nlohmann/json.hpp>
#include <optional>

#include "app/model/json.h"
#include "proc/optics/rotation.h"
#include "proc/signals/spherical_polygon.h"

namespace orbwatch::app::web {
namespace {

using Json = nlohmann::ordered_json;
using optics::Vec2;
using optics::Vec3;
using Lines = std::vector<std::vector<Vec2>>;

Json pixel_json(const Vec2& pixel) { return {pixel.u, pixel.v}; }

Json lines_json(const Lines& lines) {
  Json list = Json::array();
  for (const auto& line : lines) {
    Json pixels = Json::array();
    for (const Vec2& pixel : line) pixels.push_back(pixel_json(pixel));
    list.push_back(std::move(pixels));
  }
  return list;
}

/// Frame around the view's field of view.
Lines frame_of(const optics::ViewProjection& view) {
  const double right = view.width() - 0.5, bottom = view.height() - 0.5;
  return {{{-0.5, -0.5}, {right, -0.5}, {right, bottom}, {-0.5, bottom}, {-0.5, -0.5}}};
}

/// Outline in the view; regions with an invalid outline do not run.
Lines lines_of(const optics::ViewProjection& view, const std::vector<Vec3>& outline) {
  if (outline.empty()) return frame_of(view);
  const auto polygon = signals::SphericalPolygon::make(outline);
  return polygon ? polygon->lines_in(view) : Lines{};
}

template <std::size_t N>
void add_corners(Json& list, const std::vector<std::array<double, N>>& corners,
                 const MeasuredRecipe::Region& region, const optics::ViewProjection& view) {
  for (std::size_t i = 0; i < corners.size(); ++i) {
    const auto pixel = view.pixel(optics::normalized(region.outline[i]));
    list.push_back({{"at", corners[i]}, {"pixel", pixel ? pixel_json(*pixel) : Json()}});
  }
}

Json region_json(const MeasuredRecipe& recipe, const MeasuredRecipe::Region& region) {
  const MeasuredRecipe::View& view = recipe.views[region.view];
  Json corners = Json::array();
  add_corners(corners, region.directions, region, *view.projection);
  add_corners(corners, region.points, region, *view.projection);
  const char* kind = !region.points.empty()       ? "points"
                     : !region.directions.empty() ? "directions"
                                                  : "whole_view";
  return {{"name", region.name},
          {"view", view.name},
          {"kind", kind},
          {"corners", std::move(corners)},
          {"lines", lines_json(lines_of(*view.projection, region.outline))}};
}

Json alarm_json(const MeasuredRecipe& recipe, std::size_t index) {
  const signals::AlarmLimits& limits = recipe.alarms[index];
  const signals::SignalInfo& signal = signals::kSignals[limits.signal];
  Json alarm{{"alarm", index + 1},
             {"region", recipe.regions[limits.region].name},
             {"signal", signal.name},
             {"unit", signal.unit}};
  for (const signals::LimitInfo& limit : signals::kLimits) {
    const auto& value = limits.*limit.value;
    alarm[limit.name] = value ? to_json(*value) : Json();
  }
  alarm[signals::kHysteresis] = to_json(limits.hysteresis);
  return alarm;
}

}  // namespace

std::string recipe_json(const MeasuredRecipe& recipe) {
  Json views = Json::array(), regions = Json::array(), alarms = Json::array();
  for (const auto& [name, view] : recipe.views) {
    views.push_back({{"name", name}, {"width", view->width()}, {"height", view->height()}});
  }
  for (const auto& region : recipe.regions) regions.push_back(region_json(recipe, region));
  for (std::size_t i = 0; i < recipe.alarms.size(); ++i) alarms.push_back(alarm_json(recipe, i));
  return Json{{"number", recipe.number},
              {"name", recipe.name},
              {"views", std::move(views)},
              {"regions", std::move(regions)},
              {"alarms", std::move(alarms)}}
      .dump(-1, ' ', false, Json::error_handler_t::replace);
}

Result<std::string> polygon_json(const optics::ViewProjection& view,
                                 const signals::RegionScene& scene,
                                 const std::vector<Vec2>& pixels) {
  std::vector<Vec3> outline;
  Json corners = Json::array();
  for (const Vec2& pixel : pixels) {
    const auto direction = view.direction(pixel.u, pixel.v);
    if (!direction) return fail("the view shows nothing at one of these pixels");
    outline.push_back(*direction);
    const double closeness = scene.proxy.hit(*direction).closeness;
    const Vec3 point = scene.ball.centre + *direction * (scene.ball.radius / closeness);
    const optics::YawPitchRoll angles = optics::yaw_pitch(*direction);
    corners.push_back({{"direction", {angles.yaw, angles.pitch}},
                       {"point", closeness > 0 ? Json{point.x, point.y, point.z} : Json()}});
  }
  return signals::SphericalPolygon::make(outline).map([&](const auto& polygon) {
    return Json{{"corners", std::move(corners)}, {"lines", lines_json(polygon.lines_in(view))}}
        .dump();
  });
}

}  // namespace orbwatch::app::web
