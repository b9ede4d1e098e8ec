#pragma once

namespace orbwatch::align {

/// What is known of the best limb of a picture when it is judged.
struct LimbEvidence {
  double rank = 0;        ///< Circle::rank()
  double radius = 0;      ///< px, at the scale at which the rank was found
  double near_drop = 0;   ///< near_drop()
  double contour = 0;     ///< LimbScore::contour
  double likelihood = 0;  ///< LimbLikelihood::above_random(), nats per sector
  /// By how much the fit at another scale differs, as a share of what is right: 2 % or 3 px.
  double shift = 0;
};

/// Below that likelihood the surroundings do not end as a ball's: a dome's rim, or a mirror that is
/// let into something.
constexpr double kLeastLikelihood = 1.1;

/// px: a smaller limb tells too little, whatever else speaks for it.
constexpr double kLeastRadius = 45;

/// From the certainty on, an outline is trusted.
constexpr double kCertain = 3.3;

/// The logarithm of the odds that the limb is a ball's and right to 2 % or 3 px: a logistic
/// regression over the best limbs of 110 simulated rooms with a ball and 50 without. Below 0 for a
/// limb below kLeastLikelihood or kLeastRadius. Reentrant.
double certainty(const LimbEvidence& evidence);

}  // namespace orbwatch::align
