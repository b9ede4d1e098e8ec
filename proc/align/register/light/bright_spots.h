// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <span>
#include <vector>

#include "proc/image/picture.h"
#include "proc/image/result.h"
#include "proc/optics/outline.h"
#include "proc/optics/vec.h"

namespace orbwatch::align {

/// A spot that is brighter than its place at most other times: a spark, a melt pool.
struct BrightSpot {
  optics::Vec2 centre;  ///< px
  double light = 0;     ///< sum of its counts above the background
};

/// The brightest spots on the ball in every picture of a fixed camera, against the median of all,
/// at most kMostSpots each, the brightest first. `limb`: px; light outside of it does not count.
/// None: the limb is not known, and spots of the whole picture count. Reentrant. Error: fewer than
/// kLeastPictures, or different sizes.
Result<std::vector<std::vector<BrightSpot>>> bright_spots(
    std::span<const Picture> pictures, const std::optional<optics::Outline>& limb);

inline constexpr std::size_t kMostSpots = 12;
inline constexpr std::size_t kLeastPictures = 5;

}  // namespace orbwatch::align
