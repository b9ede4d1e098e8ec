#include "app/ports/web/views/aim.h"

#include <nlohmann/json.hpp>

namespace orbwatch::app::web {

nlohmann::ordered_json json_of(const Aim& aim) {
  nlohmann::ordered_json weights = nlohmann::ordered_json::array();
  for (const double weight : aim.weights) {
    if (weight > 0) weights.push_back(weight);
  }
  const optics::YawPitchRoll& angles = aim.spec.orientation;
  return {{"yaw", angles.yaw},
          {"pitch", angles.pitch},
          {"roll", angles.roll},
          {"h_fov", optics::h_fov_of(aim.spec)},
          {"weights", std::move(weights)}};
}

}  // namespace orbwatch::app::web
