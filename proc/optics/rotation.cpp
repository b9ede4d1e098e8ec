// SPDX-License-Identifier: Apache-2.0
#include "proc/optics/rotation.h"

#include <algorithm>
#include <cmath>

namespace orbwatch::optics {

Mat3 rotation(const YawPitchRoll& angles) {
  const double cy = std::cos(radians(angles.yaw)), sy = std::sin(radians(angles.yaw));
  const double cp = std::cos(radians(angles.pitch)), sp = std::sin(radians(angles.pitch));
  const double cr = std::cos(radians(angles.roll)), sr = std::sin(radians(angles.roll));
  const Mat3 yaw{{cy, sy, 0}, {-sy, cy, 0}, {0, 0, 1}};
  const Mat3 pitch{{1, 0, 0}, {0, cp, -sp}, {0, sp, cp}};
  const Mat3 roll{{cr, 0, sr}, {0, 1, 0}, {-sr, 0, cr}};
  return yaw * pitch * roll;
}

YawPitchRoll yaw_pitch_roll(const Mat3& rotation) {
  const Vec3 right = rotation.column0(), forward = rotation.column1(), up = rotation.column2();
  const double pitch = std::asin(std::clamp(forward.z, -1.0, 1.0));
  if (std::hypot(forward.x, forward.y) < 1e-12) {
    return {degrees(std::atan2(-right.y, right.x)), degrees(pitch), 0};
  }
  return {degrees(std::atan2(forward.x, forward.y)), degrees(pitch),
          degrees(std::atan2(-right.z, up.z))};
}

YawPitchRoll yaw_pitch(const Vec3& direction) {
  return {degrees(std::atan2(direction.x, direction.y)),
          degrees(std::asin(std::clamp(direction.z, -1.0, 1.0))), 0};
}

Result<Mat3> checked_rotation(const Mat3& matrix) {
  constexpr double kTolerance = 1e-6;
  const Mat3 product = matrix * transposed(matrix);
  const Mat3 identity;
  const double deviation =
      std::max({norm(product.row0 - identity.row0), norm(product.row1 - identity.row1),
                norm(product.row2 - identity.row2)});
  const double determinant = dot(matrix.row0, cross(matrix.row1, matrix.row2));
  if (!(deviation <= kTolerance) || !(determinant > 0)) {
    return fail(
        "the matrix is not a rotation: its rows must be unit vectors, perpendicular and "
        "right-handed, to 1e-6");
  }
  return matrix;
}

}  // namespace orbwatch::optics
