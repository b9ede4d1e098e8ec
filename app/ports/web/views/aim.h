#pragma once

#include <array>
#include <nlohmann/json_fwd.hpp>

#include "app/model/view.h"

namespace orbwatch::app::web {

/// Where a view looks and how it mixes its cameras: what the commands point_view and mix_sources
/// change.
struct Aim {
  optics::ViewSpec spec;
  std::array<double, remap::kMaxSources> weights{};  ///< as View::weights
};

inline Aim aim_of(const View& view) { return {view.spec, view.weights}; }

/// {"yaw", "pitch", "roll", "h_fov": deg, "weights": [one for each source]}. Reentrant.
nlohmann::ordered_json json_of(const Aim& aim);

}  // namespace orbwatch::app::web
