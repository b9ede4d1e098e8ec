#pragma once

#include <array>
#include <cstddef>
#include <optional>
#include <string>
#include <vector>

#include "app/model/status.h"
#include "app/pipeline/measurement/recipe_plan.h"
#include "app/pipeline/views/view_settings.h"
#include "proc/settings/settings.h"

namespace orbwatch::app {

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
  v.required("name", region.name, "Its name in process state and messages");
  v.required("view", region.view, "Name of the recipe's view in which it is measured");
  v.optional("directions", region.directions, kAnyNumber,
             "Corners [yaw, pitch] of a polygon, deg, seen from the ball; else the whole view");
  v.optional("points", region.points, kAnyNumber,
             "Instead of directions: corners [x, y, z] in the machine frame, mm");
  v.required("hot_spot_threshold", region.hot_spot_threshold, threshold,
             "Where the hot spot begins: degC for a radiometric camera, else percent of full "
             "scale");
  v.optional("hot_spot_min_area", region.hot_spot_min_area, Range::above(0, 1e6),
             "What is smaller is a spark, or a hot spot of which too much is hidden, mm2 on the "
             "machine's surface; needs the rig's scene, with which a pixel of the view is "
             "assumed");
  v.optional("hot_spot_max_speed", region.hot_spot_max_speed, Range::above(0, 1e5),
             "The hot spot's centre moves no faster, mm/s on the machine's surface: while it is "
             "hidden, nothing farther away is taken for it for half a second; needs the rig's "
             "scene, with which 200 is assumed, or a pixel of the view per frame if that is more");
  v.optional("plume_threshold", region.plume_threshold, threshold,
             "Where the plume around it begins, in the same unit; else it is not measured");
  v.optional("spatter_threshold", region.spatter_threshold, threshold,
             "Where a spark begins, in the same unit; else they are not counted");
  v.optional("width", region.width, Range::above(0, 10000),
             "Set-point of the hot spot's width, mm; else there is no width error");
  v.optional("emissivity", region.emissivity, Range::between(0.01, 1),
             "Of the target, at the camera's wavelength; else temperatures are apparent");
  v.optional("surroundings_temperature", region.surroundings_temperature,
             Range::between(-273, 5000), "Of what the target reflects, degC; else 20");
  v.tables("alarm", region.alarms, 0, signals::kMaxAlarms, "Limits of its signals");
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
  v.required("name", control.name, "As in the configuration's [[camera.control]]");
  v.required("value", control.value, kAnyNumber,
             "In the camera's units; for a menu, the entry's number");
}

template <class Visitor>
void visit(Visitor& v, Recipe& recipe) {
  v.required("name", recipe.name, "For people");
  v.optional("process_active", recipe.process_active, kActiveSources,
             "When the process is active; outside it no process alarm is raised. input: by a "
             "line; command: by the PLC or the controller; detected: while there is a hot spot, "
             "and alarms act also while that is not measured");
  v.optional_if(recipe.process_active == ActiveSource::Input, "process_active = \"input\"",
                "process_input", recipe.process_input, "Name of the line, for input");
  v.require((recipe.process_active == ActiveSource::Input) != recipe.process_input.name.empty(),
            "process_active", "\"input\" needs process_input");
  v.optional("settle_frames", recipe.settle_frames, Range::between(0, 1000),
             "Frame sets that are not measured once the cameras have taken on a recipe's settings, "
             "which is waited for anyway: for a light or a lens that needs longer");
  v.tables("view", recipe.views, 1, kMaxViews,
           "Views that are measured; they cannot be pointed, and are never slowed down");
  v.tables("region", recipe.regions, 1, signals::kMaxRegions, "What is measured");
  v.tables("control", recipe.controls, 0, 64,
           "Settings of cameras, applied in this order when the recipe is selected");
}

}  // namespace orbwatch::app
