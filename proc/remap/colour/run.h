// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstdint>

#include "proc/remap/grid/coordinate.h"

namespace orbwatch::remap {

/// Number of adjacent pixels that are converted together.
inline constexpr int kRun = kTile;

/// One 8 bit sample of each pixel of a run.
using SampleRun = std::array<std::uint8_t, kRun>;

}  // namespace orbwatch::remap
