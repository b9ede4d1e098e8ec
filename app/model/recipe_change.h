#pragma once

#include <array>
#include <cstddef>
#include <optional>
#include <string>
#include <vector>

namespace orbwatch::app {

/// One limit of an alarm.
struct LimitChange {
  std::size_t alarm = 0;          ///< from 1, in the order of the recipe's file
  std::string region;             ///< in which it is known to be
  std::string signal;             ///< that it is known to watch
  std::string limit;              ///< a name of signals::kLimits, or signals::kHysteresis
  std::optional<double> value{};  ///< in the signal's unit; nullopt: it has none any more
};

/// What a new region needs besides its corners.
struct NewRegion {
  std::string view;               ///< in which it is measured
  double hot_spot_threshold = 0;  ///< degC for a radiometric camera, else percent of full scale
};

/// The corners of a region, directions or points, as its recipe has them; or that it goes, with its
/// alarms.
struct RegionChange {
  std::string name;
  std::vector<std::array<double, 2>> directions{};  ///< yaw, pitch, deg
  std::vector<std::array<double, 3>> points{};      ///< machine frame, mm
  std::optional<NewRegion> added{};                 ///< nullopt: there is such a region
  bool is_removed = false;                          ///< then there is nothing but its name
};

/// A recipe's changes by hand, one for each limit and region.
struct RecipeChange {
  std::vector<LimitChange> limits{};
  std::vector<RegionChange> regions{};
};

}  // namespace orbwatch::app
