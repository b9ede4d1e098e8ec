// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <span>
#include <vector>

#include "proc/align/drift/picture_motion.h"
#include "proc/align/drift/reference_scale.h"

namespace orbwatch::align {

/// The motion on which most patches of a group agree.
struct Consensus {
  PictureMotion motion;
  double agreeing = 0;  ///< patches, weighted by their agreement
  int expected = 0;     ///< patches that could agree
  int octants = 0;      ///< octants of directions from the ball's centre with a patch that agrees

  double share() const { return expected > 0 ? agreeing / expected : 0; }
};

/// Estimates the motion from the patches' shifts, many of which may be wrong: parts of the scene
/// move, sparks fly. Robust least squares (Geman and McClure, from wide to narrow) from each of
/// `starts` and from the median shift; the earliest start wins unless another is better by a fifth.
/// Lengths in units of `radius`, the outline's, for a weak prior on growth and roll. Reentrant.
Consensus consensus(const Sighting& sighting, std::span<const PictureMotion> starts, double radius);

}  // namespace orbwatch::align
