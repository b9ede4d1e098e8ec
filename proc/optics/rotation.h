// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "proc/image/result.h"
#include "proc/optics/vec.h"

namespace orbwatch::optics {

/// Angles in degrees, applied intrinsically in this order: yaw about Z (from +Y towards +X), pitch
/// about the new X (up positive), roll about the new Y (the right side dips).
struct YawPitchRoll {
  double yaw = 0;
  double pitch = 0;
  double roll = 0;
};

/// The rotation R = yaw pitch roll. Its columns are the rotated axes: right, forward, up.
Mat3 rotation(const YawPitchRoll& angles);

/// The angles of a rotation, pitch in [-90, 90]; roll is 0 at pitch +-90. The inverse of
/// rotation().
YawPitchRoll yaw_pitch_roll(const Mat3& rotation);

/// The yaw and pitch of a unit vector; roll is 0.
YawPitchRoll yaw_pitch(const Vec3& direction);

/// Returns `matrix` if it is a rotation: orthonormal and right-handed to 1e-6. Error otherwise.
Result<Mat3> checked_rotation(const Mat3& matrix);

}  // namespace orbwatch::optics
