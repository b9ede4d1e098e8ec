// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

#include "app/pipeline/views/view_plan.h"
#include "proc/settings/settings.h"
#include "proc/signals/alarm_limits.h"
#include "proc/signals/region.h"

namespace orbwatch::app::pipeline {

/// Source that decides whether the process is active.
enum class ActiveSource : std::uint8_t { Always, Input, Command, Detected };

/// Planned region of interest.
struct RegionPlan {
  std::string name;
  std::size_t view = 0;  ///< index among the recipe's views
  signals::RegionSettings settings;
};

/// Camera control that a recipe sets.
struct CameraControl {
  Reference camera;
  std::string name;
  double value = 0;
};

/// A recipe, ready to be compiled into a CompiledRecipe.
struct RecipePlan {
  std::uint16_t number = 0;     ///< number that selects it
  std::vector<ViewPlan> views;  ///< measured views
  std::vector<RegionPlan> regions;
  std::vector<signals::AlarmLimits> alarms;
  std::vector<CameraControl> controls;
  int settle_frames = 0;  ///< sets with its settings that are not measured yet
  ActiveSource process_active = ActiveSource::Always;
  std::size_t process_input = 0;  ///< index of the input, for ActiveSource::Input
};

}  // namespace orbwatch::app::pipeline
