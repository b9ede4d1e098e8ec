// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <optional>
#include <string>

#include "app/model/configuration/recipe_change.h"
#include "app/ports/web/configuration/configuration_records.h"
#include "proc/signals/alarm_board.h"

namespace orbwatch::app {

template <class Visitor>
void visit(Visitor& v, LimitChange& change) {
  v.required("alarm", change.alarm, Range::between(0, signals::kMaxAlarms),
             "Number of the alarm; 0: a new one, which gets all limits of this region and signal");
  v.required("region", change.region, "The alarm's region");
  v.required("signal", change.signal, "The alarm's signal");
  v.required("limit", change.limit,
             "low_alarm, low_warning, high_warning, high_alarm or hysteresis");
  v.required("value", change.value, "In the signal's unit; null: none");
}

template <class Visitor>
void visit(Visitor& v, RegionChange& region) {
  std::optional<std::string> view;
  std::optional<double> threshold;
  v.required("name", region.name, "Name of the region");
  v.optional("directions", region.directions, "Corners as yaw and pitch", "deg");
  v.optional("points", region.points, "Corners in the machine frame", "mm");
  v.optional("view", view, "View of a new region");
  v.optional("hot_spot_threshold", threshold,
             "Threshold of a new region, degC for a radiometric camera, else percent");
  v.optional("removed", region.is_removed, "Removes the region with its alarms");
  const bool has_corners = !region.directions.empty() || !region.points.empty();
  v.require(region.is_removed != has_corners && !(region.is_removed && view),
            "a region must have either directions or points, or only removed: true");
  v.require(view.has_value() == threshold.has_value(),
            "a region must have both view and hot_spot_threshold, or neither");
  if (view && threshold) region.added = {std::move(*view), *threshold};
}

template <class Visitor>
void visit(Visitor& v, RecipeCopy& copy) {
  v.required("number", copy.number, Range::between(1, 65535),
             "Number of the new recipe, which select_recipe passes");
  v.required("name", copy.name, "Name of the new recipe and of its file: letters, digits, - and _");
}

}  // namespace orbwatch::app

namespace orbwatch::app::web {

/// Changes of a recipe. A check ignores the seconds.
struct RecipeBody {
  std::uint16_t recipe = 0;
  RecipeChange change;
  int seconds = kUsualTrial;
};
template <class Visitor>
void visit(Visitor& v, RecipeBody& body) {
  v.required("recipe", body.recipe, "Number of the recipe");
  v.optional("limits", body.change.limits, "Limits of alarms");
  v.optional("regions", body.change.regions, "New corners, new regions, and removed ones");
  v.optional("copy", body.change.copy,
             "The changes are made in a copy, a new recipe in a file of its own, which the "
             "configuration file then names, too; the recipe stays as it is");
  visit_seconds(v, body.seconds);
}

}  // namespace orbwatch::app::web
