// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <string_view>

#include "proc/remap/remap.h"

namespace orbwatch::app {

/// Names of all colour maps: OpenCV's, and plain grey.
inline constexpr std::array<std::string_view, 5> kColourMapNames{"grey", "inferno", "turbo", "hot",
                                                                 "viridis"};

/// The 256 entries of a map. `name` is one of kColourMapNames.
remap::ColourMap::Table colour_map_table(std::string_view name);

}  // namespace orbwatch::app
