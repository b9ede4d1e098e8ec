// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <optional>

#include "app/model/command/command.h"
#include "app/model/sink/view.h"

namespace orbwatch::app::web {

/// Direction of a view, weights of its cameras and their colours, which the commands point_view,
/// mix_sources, set_colour_map and set_colour_range change.
struct Aim {
  optics::ViewSpec spec;
  std::array<double, remap::kMaxSources> weights{};                        ///< see View::weights
  std::array<std::optional<SourceColours>, remap::kMaxSources> colours{};  ///< see View::colours
};

inline Aim aim_of(const View& view) { return {view.spec, view.weights, view.colours}; }

/// For a checked command that changes an aim, the command with the aim's present values. Nullopt: a
/// command of another kind, or for a missing source. Reentrant.
std::optional<Command> at_present(const Command& command, const Aim& aim);

}  // namespace orbwatch::app::web
