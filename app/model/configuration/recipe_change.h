// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

namespace orbwatch::app {

/// One limit of an alarm. Limits of a region's signal without an alarm are those of one new alarm.
struct LimitChange {
  std::size_t alarm = 0;          ///< from 1, in the order of the recipe's file; 0: a new one
  std::string region;             ///< the alarm's region, to detect a stale request
  std::string signal;             ///< the alarm's signal, to detect a stale request
  std::string limit;              ///< a name of signals::kLimits, or signals::kHysteresis
  std::optional<double> value{};  ///< in the signal's unit; nullopt: removes the limit
};

/// Settings of a new region besides its corners.
struct NewRegion {
  std::string view;               ///< name of the view in which it is measured
  double hot_spot_threshold = 0;  ///< degC for a radiometric camera, else percent of full scale
};

/// Change of a region: new corners as directions or points, whichever the recipe uses, or its
/// removal together with its alarms.
struct RegionChange {
  std::string name;
  std::vector<std::array<double, 2>> directions{};  ///< yaw, pitch, deg
  std::vector<std::array<double, 3>> points{};      ///< machine frame, mm
  std::optional<NewRegion> added{};                 ///< nullopt: the region exists
  bool is_removed = false;                          ///< then only the name is set
};

/// A new recipe, in a file of its own beside the one that it is a copy of.
struct RecipeCopy {
  std::uint16_t number = 0;  ///< by which select_recipe selects it
  std::string name;          ///< also its file's, without the ending
};

/// Manual changes of a recipe, one for each limit and region.
struct RecipeChange {
  std::vector<LimitChange> limits{};
  std::vector<RegionChange> regions{};
  std::optional<RecipeCopy> copy{};  ///< the changes are made in a copy; nullopt: in the recipe
};

}  // namespace orbwatch::app
