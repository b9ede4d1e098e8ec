#pragma once

#include <array>
#include <cstddef>
#include <optional>
#include <string>
#include <vector>

#include "app/config/view_settings.h"
#include "app/pipeline/recipe_plan.h"

namespace orbwatch::app {

inline constexpr std::size_t kMaxRecipes = 16;

/// What a recipe's file says, checked. Which keys there are, what they may be and what they mean
/// stands in recipe_schema.h; this is where their values live and what they are by default.

struct AlarmSettings {
  int line = 0;
  std::string signal;
  std::optional<double> low_alarm;
  std::optional<double> low_warning;
  std::optional<double> high_warning;
  std::optional<double> high_alarm;
  double hysteresis = 0;
  double on_delay = 0;
  double off_delay = 0;
  double loss_delay = 1;
  bool latching = false;
  bool only_while_active = true;
};

struct RegionOfInterest {
  int line = 0;
  std::string name;
  std::string view;
  std::vector<std::array<double, 2>> directions;
  std::vector<std::array<double, 3>> points;
  double hot_spot_threshold = 0;
  std::optional<double> plume_threshold;
  std::optional<double> spatter_threshold;
  std::optional<double> width;
  std::optional<double> emissivity;
  std::optional<double> surroundings_temperature;
  std::vector<AlarmSettings> alarms;
};

/// A camera's setting while the recipe is measured.
struct CameraControlSettings {
  int line = 0;
  std::string camera;
  std::string name;
  double value = 0;
};

struct Recipe {
  std::string name;
  ActiveSource process_active = ActiveSource::Always;
  std::string process_input;
  int settle_frames = 0;
  std::vector<MeasuredViewSettings> views;
  std::vector<RegionOfInterest> regions;
  std::vector<CameraControlSettings> controls;
};

}  // namespace orbwatch::app
