// SPDX-License-Identifier: Apache-2.0
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

/// Linear relation of both: y = slope x + offset.
struct Line {
  double slope = 1;
  double offset = 0;
  // Mean of the inliers, where the line is most accurate.
  double mean_x = 0;
  double mean_y = 0;
  double weight = 0;  ///< sum of weights
};

/// Fits a line to measurements of which up to a quarter may be wrong, and both sides noisy: the
/// reduced major axis (slope^2 = variance of y / variance of x, which favours neither side) of the
/// measurements that Tukey's biweight keeps, starting from Theil's median of slopes. When the
/// spread of x or y is below 5 % of its mean the slope is undetermined: the line then runs through
/// the origin. nullopt for fewer than 8 measurements or a correlation of x and y below 0.5. Sorts
/// `measured`. Reentrant.
std::optional<Line> fit_line(std::span<Measured> measured);

}  // namespace orbwatch::remap
