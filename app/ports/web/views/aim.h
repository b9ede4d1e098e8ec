#pragma once

#include <array>
#include <nlohmann/json_fwd.hpp>
#include <optional>

#include "app/model/command.h"
#include "app/model/view.h"

namespace orbwatch::app::web {

/// Where a view looks, how it mixes its cameras and in which colours it shows them: what the
/// commands point_view, mix_sources, set_colour_map and set_colour_range change.
struct Aim {
  optics::ViewSpec spec;
  std::array<double, remap::kMaxSources> weights{};                        ///< as View::weights
  std::array<std::optional<SourceColours>, remap::kMaxSources> colours{};  ///< as View::colours
};

inline Aim aim_of(const View& view) { return {view.spec, view.weights, view.colours}; }

/// {"yaw", "pitch", "roll", "h_fov": deg, "weights": [one for each source], "colours": [{
/// "colour_map": its name, "range": [first, last]}, or null, for each source]}. Reentrant.
nlohmann::ordered_json json_of(const Aim& aim);

/// The command that would leave an aim as it is, in place of one after check() that changes it.
/// nullopt: another command, or of a source that is not there. Reentrant.
std::optional<Command> at_present(const Command& command, const Aim& aim);

}  // namespace orbwatch::app::web
