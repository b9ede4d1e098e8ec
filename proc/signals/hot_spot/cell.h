#pragma once

#include <array>

namespace orbwatch::signals {

/// The part of a unit square that is above a threshold.
struct Piece {
  double area = 1;
  // Its centroid, from the square's upper left corner: u right, v down.
  double u = 0.5;
  double v = 0.5;
  // Its variances and covariance.
  double uu = 1.0 / 12;
  double vv = 1.0 / 12;
  double uv = 0;
};

/// Between four neighbouring pixels whose counts stand `above` the threshold by so much (below when
/// negative): upper left, upper right, lower right, lower left. The border is straight between
/// where it crosses the sides, which are interpolated linearly: one square of the marching squares
/// (Lorensen, Cline: Marching cubes, 1987, in the plane). Two opposite corners are joined. At least
/// one corner is not negative.
Piece piece_above(const std::array<double, 4>& above);

}  // namespace orbwatch::signals
