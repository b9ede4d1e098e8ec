// SPDX-License-Identifier: Apache-2.0
#include "app/ports/web/views/view_list.h"

#include <cstdio>
#include <nlohmann/json.hpp>

#include "app/pictures/colour_maps.h"

namespace orbwatch::app::web {
namespace {

using Json = nlohmann::ordered_json;

/// Number of colours, enough for invisible steps.
constexpr std::size_t kStops = 18;

Json stops_of(std::string_view colour_map) {
  const remap::ColourMap::Table table = colour_map_table(colour_map);
  Json stops = Json::array();
  for (std::size_t n = 0; n < kStops; ++n) {
    const auto& [red, green, blue] = table[n * (table.size() - 1) / (kStops - 1)];
    char text[8];
    std::snprintf(text, sizeof text, "#%02x%02x%02x", red, green, blue);
    stops.push_back(text);
  }
  return stops;
}

/// Colour maps in the order of the command set_colour_map.
Json colour_maps_json() {
  Json maps = Json::array();
  for (const std::string_view name : kColourMapNames) {
    maps.push_back({{"name", name}, {"stops", stops_of(name)}});
  }
  return maps;
}

Json json_of(const PublishedSource& source) {
  return {{"camera", source.camera},
          {"is_radiometric", source.is_radiometric},
          {"colour_map", source.colour_map},
          {"range", source.range},
          {"unit", source.is_radiometric ? "degC" : "%"}};
}

Json json_of(const std::string& name, std::size_t index, const PublishedView& view,
             const std::optional<Aim>& aim) {
  Json sources = Json::array();
  for (const PublishedSource& source : view.sources) sources.push_back(json_of(source));
  const bool is_pointed = !view.measured && view.spec.kind != optics::ViewKind::Ball;
  return {{"name", name},
          {"index", index},
          {"is_measured", view.measured},
          {"is_pointed", is_pointed},
          {"is_zoomed", is_pointed && view.spec.kind == optics::ViewKind::Perspective},
          {"is_mixed", view.mixes},
          {"aim", aim ? json_of(*aim) : Json()},
          {"configured", json_of(Aim{view.spec})},
          {"sources", std::move(sources)}};
}

}  // namespace

ViewList::ViewList(const WebContext& context)
    : names_(context.names.views), views_(context.views), aims_(names_.size()) {}

Route ViewList::route() {
  Route route;
  route.method = "GET";
  route.path = "/api/v1/views";
  route.role = Role::Viewer;
  route.description =
      "Returns per view its direction, the weights of its cameras and the colours of one-channel "
      "ones, at present and as configured, and whether the commands point_view and mix_sources "
      "apply; and per colour map its colours, evenly spaced from the first value to the last. deg";
  route.type = kJson;
  route.serve = [this](const ExchangePtr& exchange) { serve(exchange); };
  return route;
}

void ViewList::accept(const View& view) {
  const std::lock_guard lock(mutex_);
  if (view.index < aims_.size()) aims_[view.index] = aim_of(view);
}

std::optional<Command> ViewList::at_present(const Command& command) const {
  const std::size_t view = command.integer(0);
  const std::lock_guard lock(mutex_);
  if (view >= aims_.size() || !aims_[view]) return std::nullopt;
  return web::at_present(command, *aims_[view]);
}

void ViewList::serve(const ExchangePtr& exchange) const {
  // Allocated before locking, so that the pipeline's thread does not wait for it.
  std::vector<std::optional<Aim>> aims(names_.size());
  {
    const std::lock_guard lock(mutex_);
    aims = aims_;
  }
  Json list = Json::array();
  for (std::size_t i = 0; i < names_.size(); ++i) {
    list.push_back(json_of(names_[i], i, views_[i], aims[i]));
  }
  exchange->answer(
      json_response(Json{{"views", std::move(list)}, {"colour_maps", colour_maps_json()}}.dump()));
}

}  // namespace orbwatch::app::web
