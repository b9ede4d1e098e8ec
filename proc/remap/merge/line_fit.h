#pragma once

#include <optional>
#include <span>

namespace orbwatch::remap {

/// Two measurements of the same quantity.
struct Measured {
  double x = 0;
  double y = 0;
  double weight = 1;  ///< above 0
};

/// Their relation: y = slope x + offset.
struct Line {
  double slope = 1;
  double offset = 0;
  // Of the inliers; at their mean the line is known best.
  double mean_x = 0;
  double mean_y = 0;
  double weight = 0;  ///< summed
};

/// The line through measurements of which up to a quarter may be wrong, and both sides noisy: the
/// reduced major axis (slope^2 = variance of y / variance of x, which favours neither side) of what
/// is left by Tukey's biweight, begun from Theil's median of slopes. When the spread of x or y is
/// below 5 % of its mean the slope is undetermined: the line then runs through the origin.
/// nullopt for fewer than 8 measurements or a correlation of x and y below 0.5. Sorts `measured`.
/// Reentrant.
std::optional<Line> fit_line(std::span<Measured> measured);

}  // namespace orbwatch::remap
