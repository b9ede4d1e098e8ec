// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "app/model/status/measured_recipe.h"
#include "app/ports/web/streams/view_query.h"
#include "proc/image/result.h"
#include "proc/signals/region.h"

/// Records of measured recipes. Pixels are [u, v]: to the right and down, pixel centres at
/// integers. All reentrant.
namespace orbwatch::app::web {

/// Lines of pixels in a view.
using SentLines = std::vector<std::vector<optics::Vec2>>;

struct SentRecipeView {
  std::string name;
  int width = 0, height = 0;
};
template <class Visitor>
void visit(Visitor& v, SentRecipeView& view) {
  v.required("name", view.name, "Name of the view");
  v.required("width", view.width, "Width of its pictures", "px");
  v.required("height", view.height, "Height of its pictures", "px");
}

struct SentCorner {
  std::vector<double> at;
  std::optional<optics::Vec2> pixel;
};
template <class Visitor>
void visit(Visitor& v, SentCorner& corner) {
  v.required("at", corner.at, "In the recipe: yaw and pitch, deg, or a point, machine frame, mm");
  v.required("pixel", corner.pixel, "In the view; null: the view cannot show it", "px");
}

struct SentRegion {
  std::string name, view, kind;
  std::vector<SentCorner> corners;
  SentLines lines;
};
template <class Visitor>
void visit(Visitor& v, SentRegion& region) {
  v.required("name", region.name, "Name of the region");
  v.required("view", region.view, "Name of its view");
  v.required("kind", region.kind, "Form of its corners: points, directions or whole_view");
  v.required("corners", region.corners, "Corners; none: the whole view");
  v.required("lines", region.lines, "Outline in the view", "px");
}

struct SentAlarm {
  std::size_t alarm = 0;
  std::string region;
  std::string_view signal, title, unit;
  signals::AlarmLimits limits;
};
template <class Visitor>
void visit(Visitor& v, SentAlarm& alarm) {
  v.required("alarm", alarm.alarm, "Argument alarm of acknowledge_alarm");
  v.required("region", alarm.region, "Name of the region");
  v.required("signal", alarm.signal, "Name of the signal");
  v.required("title", alarm.title, "Title of the signal, for people");
  v.required("unit", alarm.unit, "Unit of the signal");
  for (const signals::LimitInfo& limit : signals::kLimits) {
    v.required(limit.name, alarm.limits.*limit.value, "Limit in the unit; null: none");
  }
  v.required(signals::kHysteresis, alarm.limits.hysteresis,
             "Distance from a limit at which the alarm ends, in the unit");
}

struct SentRecipeName {
  std::uint16_t number = 0;
  std::string name;
};
template <class Visitor>
void visit(Visitor& v, SentRecipeName& recipe) {
  v.required("number", recipe.number, "Number that select_recipe passes");
  v.required("name", recipe.name, "Name of the recipe");
}

struct RecipeAnswer {
  std::uint16_t number = 0;
  std::string name;
  std::vector<SentRecipeView> views;
  std::vector<SentRegion> regions;
  std::vector<SentAlarm> alarms;
  std::vector<SentRecipeName> recipes;
};
template <class Visitor>
void visit(Visitor& v, RecipeAnswer& answer) {
  v.required("number", answer.number, "Number of the recipe; 0: there is none");
  v.required("name", answer.name, "Name of the recipe");
  v.required("views", answer.views, "Views of the recipe");
  v.required("regions", answer.regions, "Regions that are measured");
  v.required("alarms", answer.alarms, "Limits of alarms, in the order of the status");
  v.required("recipes", answer.recipes, "All recipes, of which one is selected");
}
/// Without the list of all recipes.
RecipeAnswer recipe_answer(const MeasuredRecipe& recipe);

struct RecipeQuery {
  std::optional<std::uint16_t> number;
};
template <class Visitor>
void visit(Visitor& v, RecipeQuery& query) {
  v.optional("number", query.number, "Number of the recipe; default: the selected one");
}

struct PolygonQuery : ViewQuery {
  std::string pixels;
  RecipeQuery recipe;
};
template <class Visitor>
void visit(Visitor& v, PolygonQuery& query) {
  visit(v, static_cast<ViewQuery&>(query));
  v.required("pixels", query.pixels,
             "Corners u,v,u,v,...: to the right and down, pixel centres at integers", "px");
  visit(v, query.recipe);
}

struct SentPolygonCorner {
  std::array<double, 2> direction{};
  std::optional<optics::Vec3> point;
};
template <class Visitor>
void visit(Visitor& v, SentPolygonCorner& corner) {
  v.required("direction", corner.direction, "Yaw and pitch from the ball's centre", "deg");
  v.required("point", corner.point, "On the scene's surface, machine frame; null: far", "mm");
}

struct PolygonAnswer {
  std::vector<SentPolygonCorner> corners;
  SentLines lines;
};
template <class Visitor>
void visit(Visitor& v, PolygonAnswer& answer) {
  v.required("corners", answer.corners, "Corners in the recipe's coordinates");
  v.required("lines", answer.lines, "Outline in the view", "px");
}
/// Polygon whose corners a view shows at these pixels. Errors: the view shows nothing at a pixel;
/// the corners do not form a polygon.
Result<PolygonAnswer> polygon_answer(const optics::ViewProjection& view,
                                     const signals::RegionScene& scene,
                                     const std::vector<optics::Vec2>& pixels);

}  // namespace orbwatch::app::web
