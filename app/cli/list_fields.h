#pragma once

#include "hal/inventory.h"

/// The one declaration of what `orbwatch list` shows, for its table and its JSON. A visitor offers
///   field(name, value): a text, a number, or a list of those;
///   list(name, entries): entries of a kind that has a visit() of its own.
namespace orbwatch::hal {

template <class Visitor>
void visit(Visitor& v, const CameraMode& mode) {
  v.field("format", mode.format);
  v.field("size", mode.size);
  v.field("frame_rates", mode.frame_rates);
}

template <class Visitor>
void visit(Visitor& v, const CameraControl& control) {
  v.field("control", control.name);
  v.field("minimum", control.minimum);
  v.field("maximum", control.maximum);
  v.field("step", control.step);
  v.field("default", control.default_value);
  v.field("state", control.state);
  v.field("values", control.values);
}

template <class Visitor>
void visit(Visitor& v, const CameraEntry& camera) {
  v.field("camera", camera.id);
  v.field("back_end", camera.back_end);
  v.field("model", camera.model);
  v.field("driver", camera.driver);
  v.field("bus", camera.bus);
  v.field("paths", camera.paths);
  v.field("problem", camera.problem);
  v.list("modes", camera.modes);
  v.list("controls", camera.controls);
}

template <class Visitor>
void visit(Visitor& v, const LineEntry& line) {
  v.field("line", line.offset);
  v.field("name", line.name);
  v.field("direction", line.direction);
  v.field("consumer", line.consumer);
}

template <class Visitor>
void visit(Visitor& v, const ChipEntry& chip) {
  v.field("chip", chip.label);
  v.field("path", chip.path);
  v.field("problem", chip.problem);
  v.list("lines", chip.lines);
}

template <class Visitor>
void visit(Visitor& v, const Inventory& inventory) {
  v.list("cameras", inventory.cameras);
  v.list("chips", inventory.chips);
}

}  // namespace orbwatch::hal
