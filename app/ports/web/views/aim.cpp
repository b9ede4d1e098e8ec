// SPDX-License-Identifier: Apache-2.0
#include "app/ports/web/views/aim.h"

#include "app/pictures/colour_maps.h"
#include "app/ports/web/views/view_records.h"

namespace orbwatch::app::web {
SentAim sent_aim(const Aim& aim) {
  const optics::YawPitchRoll& angles = aim.spec.orientation;
  SentAim sent{angles.yaw, angles.pitch, angles.roll, optics::h_fov_of(aim.spec), {}, {}};
  for (std::size_t n = 0; n < aim.weights.size() && aim.weights[n] > 0; ++n) {
    sent.weights.push_back(aim.weights[n]);
    auto& colours = sent.colours.emplace_back();
    if (const auto& of = aim.colours[n]) {
      colours = SentColours{std::string(kColourMapNames[of->map]), of->range};
    }
  }
  return sent;
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
