// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstddef>
#include <optional>
#include <string>
#include <vector>

#include "app/model/status/status.h"
#include "app/pipeline/measurement/recipe_plan.h"
#include "app/pipeline/views/view_settings.h"
#include "proc/settings/settings.h"

namespace orbwatch::app::pipeline {

inline constexpr std::size_t kMaxRecipes = 16;

/// Region of interest as stated in a recipe's file, in degC or percent of full scale.
struct RegionOfInterest {
  std::string name;
  Reference view;  ///< one of the recipe's views
  std::vector<std::array<double, 2>> directions;
  std::vector<std::array<double, 3>> points;
  double hot_spot_threshold = 0;
  std::optional<double> hot_spot_min_area;
  std::optional<double> hot_spot_max_speed;
  std::optional<double> plume_threshold;
  std::optional<double> spatter_threshold;
  std::optional<double> width;
  std::optional<double> emissivity;
  std::optional<double> surroundings_temperature;
  std::vector<Located<signals::AlarmLimits>> alarms;
};

/// Contents of a recipe's file.
struct Recipe {
  std::string name;
  ActiveSource process_active = ActiveSource::Always;
  Reference process_input;  ///< process input, for ActiveSource::Input
  int settle_frames = 0;
  std::vector<Located<MeasuredViewSettings>> views;
  std::vector<Located<RegionOfInterest>> regions;
  std::vector<Located<CameraControl>> controls;
};

inline constexpr std::array kActiveSources{
    Word{"always", ActiveSource::Always}, Word{"input", ActiveSource::Input},
    Word{"command", ActiveSource::Command}, Word{"detected", ActiveSource::Detected}};

template <class Visitor>
void visit(Visitor& v, RegionOfInterest& region) {
  const Range threshold = Range::between(-273, 10000);
  v.required("name", region.name, "Region name, used by process state and messages");
  v.required("view", region.view, "Name of the recipe's view in which the region is measured");
  v.optional("directions", region.directions, kAnyNumber,
             "Corners [yaw, pitch] of a polygon, deg, seen from the ball; default: the whole view");
  v.optional("points", region.points, kAnyNumber,
             "Corners [x, y, z] of the polygon in the machine frame, mm; instead of directions");
  v.required(
      "hot_spot_threshold", region.hot_spot_threshold, threshold,
      "Threshold of the hot spot: degC for a radiometric camera, else percent of full scale");
  v.optional("hot_spot_min_area", region.hot_spot_min_area, Range::above(0, 1e6),
             "Smallest area of a hot spot on the machine's surface, mm2; smaller ones are sparks, "
             "or hot spots that are mostly hidden. Needs the rig's scene; default: the area of one "
             "pixel of the view");
  v.optional(
      "hot_spot_max_speed", region.hot_spot_max_speed, Range::above(0, 1e5),
      "Highest speed of the hot spot's centre on the machine's surface, mm/s: for half a second "
      "after the hot spot is hidden, nothing farther away is accepted as the same hot spot. Needs "
      "the rig's scene; default: 200, or one pixel of the view per frame if that is more");
  v.optional("plume_threshold", region.plume_threshold, threshold,
             "Threshold of the plume around the hot spot, in the same unit; without it the plume "
             "is not measured");
  v.optional("spatter_threshold", region.spatter_threshold, threshold,
             "Threshold of a spark, in the same unit; without it sparks are not counted");
  v.optional("width", region.width, Range::above(0, 10000),
             "Set-point of the hot spot's width, mm; without it there is no width error");
  v.optional(
      "emissivity", region.emissivity, Range::between(0.01, 1),
      "Emissivity of the target at the camera's wavelength; without it temperatures are apparent");
  v.optional("surroundings_temperature", region.surroundings_temperature,
             Range::between(-273, 5000),
             "Temperature of the surroundings that the target reflects, degC; default: 20");
  v.tables("alarm", region.alarms, 0, signals::kMaxAlarms, "Limits of the region's signals");
  v.require(region.directions.empty() || region.points.empty(), "points",
            "a region has either directions or points");
  v.require(region.directions.empty() || region.directions.size() >= 3, "directions",
            "a polygon has at least three corners");
  v.require(region.points.empty() || region.points.size() >= 3, "points",
            "a polygon has at least three corners");
}

template <class Visitor>
void visit(Visitor& v, CameraControl& control) {
  v.required("camera", control.camera, "Name of the camera");
  v.required("name", control.name, "Control name, as in [[camera.control]] of the configuration");
  v.required("value", control.value, kAnyNumber,
             "Value in the camera's units; for a menu, the number of the entry");
}

template <class Visitor>
void visit(Visitor& v, Recipe& recipe) {
  v.required("name", recipe.name, "Recipe name, for display");
  v.optional("process_active", recipe.process_active, kActiveSources,
             "Source of the state process active; process alarms are raised only while it holds. "
             "input: a line; command: the PLC or the controller; detected: the presence of a hot "
             "spot, and alarms stay enabled while the hot spot is not measured");
  v.optional_if(recipe.process_active == ActiveSource::Input, "process_active = \"input\"",
                "process_input", recipe.process_input,
                "Name of the line, for process_active = \"input\"");
  v.require((recipe.process_active == ActiveSource::Input) != recipe.process_input.name.empty(),
            "process_active", "\"input\" needs process_input");
  v.optional("settle_frames", recipe.settle_frames, Range::between(0, 1000),
             "Further frame sets that are not measured after the cameras have applied a recipe's "
             "settings, for a light or a lens that settles more slowly");
  v.tables("view", recipe.views, 1, kMaxViews,
           "Measured views; commands cannot point them, and they are never slowed down");
  v.tables("region", recipe.regions, 1, signals::kMaxRegions, "Measured regions");
  v.tables("control", recipe.controls, 0, 64,
           "Camera controls, applied in this order when the recipe is selected");
}

}  // namespace orbwatch::app::pipeline
