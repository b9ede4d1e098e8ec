// SPDX-License-Identifier: Apache-2.0
#include "app/ports/web/views/aim.h"

#include <nlohmann/json.hpp>

#include "app/pictures/colour_maps.h"

namespace orbwatch::app::web {
namespace {

using Json = nlohmann::ordered_json;

Json json_of(const SourceColours& colours) {
  return {{"colour_map", kColourMapNames[colours.map]}, {"range", colours.range}};
}

}  // namespace

Json json_of(const Aim& aim) {
  Json weights = Json::array(), colours = Json::array();
  for (std::size_t n = 0; n < aim.weights.size() && aim.weights[n] > 0; ++n) {
    weights.push_back(aim.weights[n]);
    colours.push_back(aim.colours[n] ? json_of(*aim.colours[n]) : Json());
  }
  const optics::YawPitchRoll& angles = aim.spec.orientation;
  return {{"yaw", angles.yaw},
          {"pitch", angles.pitch},
          {"roll", angles.roll},
          {"h_fov", optics::h_fov_of(aim.spec)},
          {"weights", std::move(weights)},
          {"colours", std::move(colours)}};
}

std::optional<Command> at_present(const Command& command, const Aim& aim) {
  const double view = command.arguments[0], source = command.arguments[1];
  const optics::YawPitchRoll& angles = aim.spec.orientation;
  if (command.code == CommandCode::PointView) {
    return Command{command.code, {view, angles.yaw, angles.pitch, optics::h_fov_of(aim.spec)}};
  }
  const bool is_mixed = command.code == CommandCode::MixSources;
  const bool is_mapped = command.code == CommandCode::SetColourMap;
  if (!is_mixed && !is_mapped && command.code != CommandCode::SetColourRange) return std::nullopt;
  const std::size_t n = command.integer(1);
  if (n >= aim.weights.size() || !(aim.weights[n] > 0)) return std::nullopt;
  if (is_mixed) return Command{command.code, {view, source, aim.weights[n]}};
  if (!aim.colours[n]) return std::nullopt;
  const auto& [map, range] = *aim.colours[n];
  if (is_mapped) return Command{command.code, {view, source, static_cast<double>(map)}};
  return Command{command.code, {view, source, range[0], range[1]}};
}

}  // namespace orbwatch::app::web
