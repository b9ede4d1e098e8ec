// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <limits>
#include <type_traits>

#include "app/model/status/readings.h"
#include "app/model/status/status.h"

namespace orbwatch::app::web {

/// The lowest and the highest value of a figure since a moment, as precise as a chart needs them;
/// NaN: not measured.
struct Extremes {
  float low = std::numeric_limits<float>::quiet_NaN();
  float high = std::numeric_limits<float>::quiet_NaN();

  /// Adds a value; NaN is ignored.
  void add(double value) {
    const auto rounded = static_cast<float>(value);
    low = std::fmin(low, rounded);
    high = std::fmax(high, rounded);
  }
};

/// Number of fields of a part of the status.
template <class Part>
constexpr std::size_t field_count() {
  std::size_t count = 0;
  for_each_field(std::type_identity<Part>{}, [&count](const auto&) { ++count; });
  return count;
}

/// Extremes of each field of a part, by its place.
template <class Part>
struct PartExtremes : std::array<Extremes, field_count<Part>()> {
  void add(const Part& part) {
    auto* next = this->data();
    for_each_reading(part, {}, [&next](const Reading& reading) { (next++)->add(reading.value); });
  }
};

/// Extremes of all regions and of the watch figures of all cameras, over any number of statuses.
/// The size is fixed and add() allocates nothing, for the frame path.
struct StatusExtremes {
  std::uint16_t recipe = 0;  ///< recipe of the regions
  std::size_t region_count = 0;
  std::size_t camera_count = 0;
  std::array<PartExtremes<RegionStatus>, signals::kMaxRegions> regions;
  std::array<PartExtremes<CameraWatchStatus>, kMaxCameras> cameras;

  void add(const Status& status) {
    // Values of another recipe must not be mixed in.
    if (status.recipe != recipe) regions = {};
    recipe = status.recipe;
    region_count = std::min(status.region_count, regions.size());
    camera_count = std::min(status.camera_count, cameras.size());
    for (std::size_t i = 0; i < region_count; ++i) regions[i].add(status.regions[i]);
    for (std::size_t i = 0; i < camera_count; ++i) cameras[i].add(status.cameras[i]);
  }
};

}  // namespace orbwatch::app::web
