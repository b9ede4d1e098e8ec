#pragma once

#include <array>

#include "app/config/recipe.h"
#include "app/config/view_schema.h"
#include "app/pipeline/status.h"

/// The one declaration of every key of a recipe's file; the visitors are schema.h's.
namespace orbwatch::app {

inline constexpr std::array kActiveSources{
    Word{"always", ActiveSource::Always}, Word{"input", ActiveSource::Input},
    Word{"command", ActiveSource::Command}, Word{"detected", ActiveSource::Detected}};

template <class Visitor>
void visit(Visitor& v, AlarmSettings& alarm) {
  v.line(alarm.line);
  v.required("signal", alarm.signal, "Name of the signal, as in the registers' manual");
  v.optional("low_alarm", alarm.low_alarm, kAnyNumber, "In the signal's unit");
  v.optional("low_warning", alarm.low_warning, kAnyNumber, "In the signal's unit");
  v.optional("high_warning", alarm.high_warning, kAnyNumber, "In the signal's unit");
  v.optional("high_alarm", alarm.high_alarm, kAnyNumber, "In the signal's unit");
  v.optional("hysteresis", alarm.hysteresis, Range::between(0, 1e9),
             "How far the signal must come back from a limit to end what it began");
  v.optional("on_delay", alarm.on_delay, Range::between(0, 3600),
             "A limit counts once it was reached for so long, s");
  v.optional("off_delay", alarm.off_delay, Range::between(0, 3600),
             "And until the signal was back for so long, s");
  v.optional("loss_delay", alarm.loss_delay, Range::between(0, 3600),
             "Not measured for so long is an alarm of its own, s; 0: never");
  v.optional("latching", alarm.latching,
             "Stands until it is acknowledged, after its cause has gone");
  v.optional("only_while_active", alarm.only_while_active,
             "Suppressed while the process is not active");
}

template <class Visitor>
void visit(Visitor& v, RegionOfInterest& region) {
  v.line(region.line);
  v.required("name", region.name, "Its name in process state and messages");
  v.required("view", region.view, "Name of the recipe's view in which it is measured");
  v.optional("directions", region.directions, kAnyNumber,
             "Corners [yaw, pitch] of a polygon, deg, seen from the ball; else the whole view");
  v.optional("points", region.points, kAnyNumber,
             "Instead of directions: corners [x, y, z] in the machine frame, mm");
  v.required("hot_spot_threshold", region.hot_spot_threshold, Range::between(-273, 10000),
             "Where the hot spot begins: degC for a radiometric camera, else percent of full "
             "scale");
  v.optional("plume_threshold", region.plume_threshold, Range::between(-273, 10000),
             "Where the plume around it begins, in the same unit; else it is not measured");
  v.optional("spatter_threshold", region.spatter_threshold, Range::between(-273, 10000),
             "Where a spark begins, in the same unit; else they are not counted");
  v.optional("width", region.width, Range::above(0, 10000),
             "Set-point of the hot spot's width, mm; else there is no width error");
  v.optional("emissivity", region.emissivity, Range::between(0.01, 1),
             "Of what is measured, at the camera's wavelength; else temperatures are apparent");
  v.optional("surroundings_temperature", region.surroundings_temperature,
             Range::between(-273, 5000), "What it reflects, degC; else 20");
  v.tables("alarm", region.alarms, 0, signals::kMaxAlarms, "Limits of its signals");
  v.require(region.directions.empty() || region.points.empty(), "points",
            "a region has either directions or points");
  v.require(region.directions.empty() || region.directions.size() >= 3, "directions",
            "a polygon has at least three corners");
  v.require(region.points.empty() || region.points.size() >= 3, "points",
            "a polygon has at least three corners");
}

template <class Visitor>
void visit(Visitor& v, CameraControlSettings& control) {
  v.line(control.line);
  v.required("camera", control.camera, "Name of the camera");
  v.required("name", control.name, "As in the configuration's [[camera.control]]");
  v.required("value", control.value, kAnyNumber,
             "In the camera's units; for a menu, the entry's number");
}

template <class Visitor>
void visit(Visitor& v, Recipe& recipe) {
  v.required("name", recipe.name, "What people call it");
  v.optional("process_active", recipe.process_active, kActiveSources,
             "What says that the process runs; outside it no process alarm is raised. input: a "
             "line; command: the PLC or the controller; detected: there is a hot spot");
  v.optional_if(recipe.process_active == ActiveSource::Input, "process_active = \"input\"",
                "process_input", recipe.process_input, "Name of the line, for input");
  v.require((recipe.process_active == ActiveSource::Input) != recipe.process_input.empty(),
            "process_active", "\"input\" needs process_input");
  v.optional("settle_frames", recipe.settle_frames, Range::between(0, 1000),
             "Frame sets after a switch in which nothing is measured, while cameras take on their "
             "settings");
  v.tables("view", recipe.views, 1, kMaxViews,
           "Views that are measured; nobody points them elsewhere, and they are never slowed down");
  v.tables("region", recipe.regions, 1, signals::kMaxRegions, "What is measured");
  v.tables("control", recipe.controls, 0, 64,
           "What cameras are set to when the recipe is selected, in this order");
}

}  // namespace orbwatch::app
