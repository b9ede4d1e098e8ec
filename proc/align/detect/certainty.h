// SPDX-License-Identifier: Apache-2.0
#pragma once

namespace orbwatch::align {

/// Evidence for the best limb of a picture.
struct LimbEvidence {
  double radius = 0;      ///< px, at the scale at which limbs are compared
  double near_drop = 0;   ///< near_drop()
  double contour = 0;     ///< contour()
  double likelihood = 0;  ///< LimbLikelihood::above_random(), nats per part
};

/// Likelihood below which the surroundings do not end like a ball's: a dome's rim, or an embedded
/// mirror.
constexpr double kLeastLikelihood = 0.8;

/// Radius below which a limb has too little evidence, whatever its other values, px.
constexpr double kLeastRadius = 45;

/// Certainty from which on an outline is trusted.
constexpr double kCertain = 4.3;

/// The logarithm of the odds that the limb is a ball's and right to 2 % or 3 px: a logistic
/// regression over the best limbs of 250 simulated rooms with a ball and 160 without, 7 rendered
/// pictures and 9 photographs. Below 0 for a limb below kLeastLikelihood or kLeastRadius.
/// Reentrant.
double certainty(const LimbEvidence& evidence);

}  // namespace orbwatch::align
