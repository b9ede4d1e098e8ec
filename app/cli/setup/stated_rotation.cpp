// SPDX-License-Identifier: Apache-2.0
#include "app/cli/setup/stated_rotation.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <sstream>

#include "proc/align/rotation_fit.h"
#include "proc/optics/rotation.h"

namespace orbwatch::app::cli {
namespace {

using optics::Mat3;
using optics::Vec3;

/// The rotation with the least squares of element differences.
Mat3 nearest_rotation(const Mat3& matrix) {
  const Mat3 axes;
  return align::fit_rotation(std::array{align::DirectionPair{matrix.column0(), axes.row0},
                                        align::DirectionPair{matrix.column1(), axes.row1},
                                        align::DirectionPair{matrix.column2(), axes.row2}});
}

/// Root of the sum of squares of all elements' differences.
double distance(const Mat3& a, const Mat3& b) {
  return std::hypot(norm(a.row0 - b.row0), norm(a.row1 - b.row1), norm(a.row2 - b.row2));
}

/// Degrees between a row as stated and an axis close to it.
double turn(const Vec3& stated, const Vec3& axis) {
  return optics::degrees(std::asin(norm(cross(normalized(stated), axis))));
}

}  // namespace

Result<StatedRotation> stated_rotation(const Mat3& matrix) {
  if (optics::checked_rotation(matrix)) return StatedRotation{matrix, 0};
  // Nine elements that are rounded to four decimals are up to 0.00015 off, cut ones 0.0003.
  constexpr double kFarthest = 0.001;
  const Mat3 nearest = nearest_rotation(matrix);
  const double off = distance(matrix, nearest);
  // False for NaN.
  if (!(off <= kFarthest)) {
    std::ostringstream text;
    text.precision(2);
    text << "the matrix is not a rotation: the nearest one differs by " << off << ", at most "
         << kFarthest
         << " is allowed; its rows must be unit vectors, perpendicular and "
            "right-handed, with four decimals or more";
    return fail(text.str());
  }
  return StatedRotation{nearest,
                        std::max({turn(matrix.row0, nearest.row0), turn(matrix.row1, nearest.row1),
                                  turn(matrix.row2, nearest.row2)})};
}

}  // namespace orbwatch::app::cli
