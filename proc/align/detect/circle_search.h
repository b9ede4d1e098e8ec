#pragma once

#include "proc/align/detect/polar_evidence.h"

namespace orbwatch::align {

/// A circle that may be a ball's limb, pixels.
struct Circle {
  optics::Vec2 centre;
  double radius = 0;
  double evidence = 0;  ///< PolarEvidence

  /// For comparing circles of any size and at any scale: evidence per area, less for small ones,
  /// whose few slopes agree by accident.
  double rank() const;
};

/// The circle around `centre` with the highest rank and a radius between `nearest` and `farthest`.
/// Reentrant.
Circle best_circle(const Slopes& slopes, const ReflectionLaw& law, optics::Vec2 centre,
                   double nearest, double farthest);

/// From `circle` uphill by rank, in steps that begin with the share `first` of its radius.
/// Reentrant.
Circle climb(const Slopes& slopes, const ReflectionLaw& law, const Circle& circle, double first);

}  // namespace orbwatch::align
