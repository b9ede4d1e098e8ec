#pragma once

#include <span>
#include <vector>

#include "proc/align/drift/picture_motion.h"
#include "proc/align/drift/reference_scale.h"

namespace orbwatch::align {

/// The motion on which most patches of a group agree.
struct Consensus {
  PictureMotion motion;
  double agreeing = 0;  ///< patches, each by how well it agrees
  int expected = 0;     ///< patches that could have
  int octants = 0;      ///< of the directions from the ball's centre, in which some agree

  double share() const { return expected > 0 ? agreeing / expected : 0; }
};

/// From the patches' shifts, of which many may be wrong: parts of the scene move, sparks fly.
/// Robust least squares (Geman and McClure, from wide to narrow) from every one of `starts` and
/// from the median shift; the earliest start wins unless another is better by a fifth. Lengths in
/// units of `radius`, the outline's, for a weak prior on growth and roll. Reentrant.
Consensus consensus(const Sighting& sighting, std::span<const PictureMotion> starts, double radius);

}  // namespace orbwatch::align
