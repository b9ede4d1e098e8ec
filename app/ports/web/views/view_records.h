// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <optional>
#include <string>
#include <vector>

#include "app/ports/web/views/aim.h"

/// Records of views.
namespace orbwatch::app::web {

struct SentColours {
  std::string colour_map;
  std::array<double, 2> range{};
};
template <class Visitor>
void visit(Visitor& v, SentColours& colours) {
  v.required("colour_map", colours.colour_map, "Name of the colour map");
  v.required("range", colours.range, "Values of the first and last colour");
}

/// An Aim as it is sent.
struct SentAim {
  double yaw = 0, pitch = 0, roll = 0, h_fov = 0;
  std::vector<double> weights;
  std::vector<std::optional<SentColours>> colours;
};
template <class Visitor>
void visit(Visitor& v, SentAim& aim) {
  v.required("yaw", aim.yaw, "From +Y towards +X", "deg");
  v.required("pitch", aim.pitch, "Up positive", "deg");
  v.required("roll", aim.roll, "Positive lowers the right side", "deg");
  v.required("h_fov", aim.h_fov, "Horizontal field of view", "deg");
  v.required("weights", aim.weights, "Weight of each source where several overlap");
  v.required("colours", aim.colours, "Colours of each source; null: it has no colour map");
}
/// Reentrant.
SentAim sent_aim(const Aim& aim);

struct SentSource {
  std::string camera;
  bool is_radiometric = false;
  SentColours colours;
  std::string unit;
};
template <class Visitor>
void visit(Visitor& v, SentSource& source) {
  v.required("camera", source.camera, "Name of the camera");
  v.required("is_radiometric", source.is_radiometric, "Its counts are temperatures");
  visit(v, source.colours);
  v.required("unit", source.unit, "Unit of the range: degC or %");
}

struct SentView {
  std::string name;
  std::size_t index = 0;
  int width = 0, height = 0;
  std::vector<int> widths;
  bool is_measured = false, is_pointed = false, is_zoomed = false, is_mixed = false;
  std::optional<SentAim> aim;
  SentAim configured;
  std::vector<SentSource> sources;
};
template <class Visitor>
void visit(Visitor& v, SentView& view) {
  v.required("name", view.name, "Name of the view");
  v.required("index", view.index, "Argument view of commands");
  v.required("width", view.width, "Width of its full picture", "px");
  v.required("height", view.height, "Height of its full picture", "px");
  v.required("widths", view.widths,
             "Widths of the sizes in which its pictures are sent, the largest first", "px");
  v.required("is_measured", view.is_measured, "It has a plane that is measured");
  v.required("is_pointed", view.is_pointed, "point_view changes its direction");
  v.required("is_zoomed", view.is_zoomed, "point_view changes its field of view");
  v.required("is_mixed", view.is_mixed, "mix_sources changes its weights");
  v.required("aim", view.aim, "At present; null: no picture yet");
  v.required("configured", view.configured, "In the configuration");
  v.required("sources", view.sources, "Its cameras");
}

struct SentColourMap {
  std::string name;
  std::vector<std::string> stops;
};
template <class Visitor>
void visit(Visitor& v, SentColourMap& map) {
  v.required("name", map.name, "Name of the colour map");
  v.required("stops", map.stops, "Colours #rrggbb, evenly spaced from the first value to the last");
}

struct ViewsAnswer {
  std::vector<SentView> views;
  std::vector<SentColourMap> colour_maps;
};
template <class Visitor>
void visit(Visitor& v, ViewsAnswer& answer) {
  v.required("views", answer.views, "All views");
  v.required("colour_maps", answer.colour_maps, "In the order of the command set_colour_map");
}

}  // namespace orbwatch::app::web
