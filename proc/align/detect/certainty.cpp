// SPDX-License-Identifier: Apache-2.0
#include "proc/align/detect/certainty.h"

#include <algorithm>
#include <cmath>

namespace orbwatch::align {
namespace {

/// Radius above which certainty no longer grows, px.
constexpr double kLargeEnough = 90;
/// Likelihood above which certainty no longer grows.
constexpr double kEnough = 2.5;

/// Evidence for a disc. A ball's limb is hardly a step, since it reflects its background. A sharp
/// edge all around belongs to a disc or a matt sphere, unless it is also very much like a ball's.
double disc(const LimbEvidence& evidence) {
  constexpr double kSharp = 0.85, kVeryLikely = 3;
  return std::max(evidence.contour - kSharp, 0.0) *
         std::clamp(kVeryLikely - evidence.likelihood, 0.0, 1.0);
}

}  // namespace

double certainty(const LimbEvidence& e) {
  const double odds = 6.6 * std::log(std::min(e.radius, kLargeEnough) / 60) + 12.2 * e.near_drop +
                      2.6 * std::min(e.likelihood, kEnough) - 63 * disc(e) - 5.7;
  const bool is_enough = e.likelihood >= kLeastLikelihood && e.radius >= kLeastRadius;
  return is_enough ? odds : std::min(odds, -0.1);
}

}  // namespace orbwatch::align
