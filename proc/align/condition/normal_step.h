// SPDX-License-Identifier: Apache-2.0
#pragma once

namespace orbwatch::align {

/// The normal distribution at one place.
struct NormalStep {
  double share = 0;    ///< the integral up to x: (1 + erf(x / sqrt 2)) / 2
  double density = 0;  ///< exp(-x^2 / 2) / sqrt(2 pi)
};

/// Both from one table, by Taylor's series from the nearest of its nodes; off by less than
/// kNormalStepError. NaN at x that is NaN. Reentrant.
NormalStep normal_step(double x);

/// The bound of either error: 1.5 times the first term that the series leaves out.
inline constexpr double kNormalStepError = 5e-9;

}  // namespace orbwatch::align
