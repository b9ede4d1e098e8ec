#pragma once

namespace orbwatch::align {

/// What is known of the best limb of a picture when it is judged.
struct LimbEvidence {
  double radius = 0;      ///< px, at the scale at which limbs are compared
  double near_drop = 0;   ///< near_drop()
  double contour = 0;     ///< contour()
  double likelihood = 0;  ///< LimbLikelihood::above_random(), nats per part
};

/// Below that likelihood the surroundings do not end as a ball's: a dome's rim, or a mirror that is
/// let into something.
constexpr double kLeastLikelihood = 0.8;

/// px: a smaller limb tells too little, whatever else speaks for it.
constexpr double kLeastRadius = 45;

/// From the certainty on, an outline is trusted.
constexpr double kCertain = 4.3;

/// The logarithm of the odds that the limb is a ball's and right to 2 % or 3 px: a logistic
/// regression over the best limbs of 250 simulated rooms with a ball and 160 without, 7 rendered
/// pictures and 9 photographs. Below 0 for a limb below kLeastLikelihood or kLeastRadius.
/// Reentrant.
double certainty(const LimbEvidence& evidence);

}  // namespace orbwatch::align
