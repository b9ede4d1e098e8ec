#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

#include "app/pipeline/view_renderer.h"
#include "proc/signals/alarm_limits.h"
#include "proc/signals/region.h"

namespace orbwatch::app {

/// What says that the process runs.
enum class ActiveSource : std::uint8_t { Always, Input, Command, Detected };

/// One region of interest.
struct RegionPlan {
  std::string name;
  std::size_t view = 0;  ///< index among the recipe's views
  signals::RegionSettings settings;
};

/// What a camera is set to while a recipe is measured.
struct CameraControl {
  std::size_t camera = 0;
  std::string name;
  double value = 0;
};

/// A recipe, ready to be compiled.
struct RecipePlan {
  std::uint16_t number = 0;     ///< by which it is selected
  std::vector<ViewPlan> views;  ///< each one measured
  std::vector<RegionPlan> regions;
  std::vector<signals::AlarmLimits> alarms;
  std::vector<CameraControl> controls;
  int settle_frames = 0;  ///< sets after a switch in which nothing is measured
  ActiveSource process_active = ActiveSource::Always;
  std::size_t process_input = 0;  ///< for ActiveSource::Input: which one
};

}  // namespace orbwatch::app
