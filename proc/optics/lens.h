// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <limits>
#include <optional>

#include "proc/image/result.h"
#include "proc/optics/vec.h"

namespace orbwatch::optics {

/// OpenCV's distortion models: ROS' plumb_bob and rational_polynomial are one formula (Pinhole),
/// equidistant is OpenCV's fisheye.
enum class Distortion { None, Pinhole, Fisheye };

/// A camera's calibration in the conventions of OpenCV and ROS. Camera frame: x right, y down, z
/// forward; pixels with centres at integers.
struct Intrinsics {
  int width = 0;
  int height = 0;
  double fx = 0;
  double fy = 0;
  double cx = 0;
  double cy = 0;
  Distortion distortion = Distortion::None;
  /// Pinhole: k1 k2 p1 p2 k3 k4 k5 k6, OpenCV's order; Fisheye: k1 k2 k3 k4. The rest is 0.
  std::array<double, 8> coefficients{};
};

/// Converts directions in the camera frame to pixels and back. Source: OpenCV's calib3d
/// documentation. Only the injective part of the distortion is used: beyond the angle where the
/// picture would fold back, functions return nullopt. Reentrant, immutable.
class Lens {
 public:
  /// Error: sizes outside 1..kMaxSide, focal lengths that are not above 0, numbers that are not
  /// finite, coefficients that the model does not have, a distortion that folds less than a tenth
  /// of the picture's shorter side away from the principal point.
  static Result<Lens> make(const Intrinsics& intrinsics);

  /// The pixel that shows a direction (any length); it may lie outside of the picture. nullopt
  /// beyond the fold or, except for a fisheye, behind the camera.
  std::optional<Vec2> pixel(const Vec3& direction) const {
    return straight_ ? straight_pixel(direction) : distorted_pixel(direction);
  }

  /// Unit vector of a pixel; nullopt beyond the fold.
  std::optional<Vec3> direction(const Vec2& pixel) const;

  const Intrinsics& intrinsics() const { return intrinsics_; }

 private:
  explicit Lens(const Intrinsics& intrinsics);

  std::optional<Vec2> straight_pixel(const Vec3& direction) const {
    // 1 / z is infinite below the smallest normal number.
    if (!(direction.z >= std::numeric_limits<double>::min())) return std::nullopt;
    const double per_depth = 1 / direction.z;
    return Vec2{intrinsics_.fx * (direction.x * per_depth) + intrinsics_.cx,
                intrinsics_.fy * (direction.y * per_depth) + intrinsics_.cy};
  }
  std::optional<Vec2> distorted_pixel(const Vec3& direction) const;

  Intrinsics intrinsics_;
  bool straight_;  ///< a pinhole without distortion: straight lines stay straight
  double limit_;   ///< before the fold; pinhole: largest tangent, fisheye: largest angle in radians
};

}  // namespace orbwatch::optics
