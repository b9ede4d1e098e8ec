// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <string>
#include <vector>

#include "proc/optics/view_projection.h"
#include "proc/signals/alarm_limits.h"

namespace orbwatch::app {

/// Regions and limits of a recipe, for interfaces that show and change them.
struct MeasuredRecipe {
  struct View {
    std::string name;
    std::shared_ptr<const optics::ViewProjection> projection;
  };
  struct Region {
    std::string name;
    std::size_t view = 0;  ///< index in `views`
    // Corners as in the file: one of these, or neither for the whole view.
    std::vector<std::array<double, 2>> directions{};  ///< yaw, pitch, deg
    std::vector<std::array<double, 3>> points{};      ///< machine frame, mm
    std::vector<optics::Vec3> outline{};  ///< measured outline: see signals::RegionSettings
  };

  std::uint16_t number = 0;
  std::string name;
  std::vector<View> views;
  std::vector<Region> regions;
  std::vector<signals::AlarmLimits> alarms;  ///< in the order of the status
};

}  // namespace orbwatch::app
