// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "proc/image/result.h"

namespace orbwatch::align {

/// A planned camera and ball. Lengths in mm unless stated otherwise.
struct Arrangement {
  double ball_diameter = 0;
  double distance = 0;             ///< from the camera's entrance pupil to the ball's centre
  double focal_length = 0;         ///< nominal focal length of the lens
  double pixel = 0;                ///< pitch, micrometres
  int sensor_width = 0;            ///< px
  int sensor_height = 0;           ///< px
  double target_distance = 0;      ///< from the ball's centre to the target
  std::optional<double> smallest;  ///< size of the smallest detail to be measured
};

/// Resolution of a target in one direction.
struct TargetSight {
  double phi = 0;  ///< degrees between the direction to the target and the one to the camera
  double pixels_per_degree = 0;  ///< along the worse of the picture's two main directions
  double pixels_per_mm = 0;      ///< the same on a target that faces the ball
  double smallest = 0;           ///< mm that cover kMeasuredPixels in the picture
  /// Angular error, degrees, of a view that assumes everything to be far away.
  double parallax = 0;
};

/// Pixels across the smallest detail that can be measured.
inline constexpr double kMeasuredPixels = 3;

struct Advice {
  double alpha = 0;        ///< reflected field of view, degrees
  double ball_pixels = 0;  ///< radius of the ball's picture on the optical axis, px
  double fill = 0;         ///< the ball's diameter relative to the sensor's short side
  double focus = 0;        ///< focus distance, mm from the entrance pupil
  /// Depth to be sharp, mm: from the mirror image of the target in the middle of the ball to the
  /// limb.
  double depth_of_field = 0;
  double f_number = 0;  ///< smallest f-number that keeps both sharp to a pixel
  /// Largest f-number before diffraction blurs by more than two pixels (Airy disc, 550 nm).
  double diffraction_f_number = 0;
  /// Ascending phi: 0, 60, 90, 120, 150 degrees, as far as visible.
  std::vector<TargetSight> sights;
  /// Advised changes, the most useful first; empty if none is needed.
  std::vector<std::string> changes;
};

/// Predicts the picture of an arrangement by the exact model for a camera that looks at the ball.
/// The depth of field follows the thin lens: a point at distance s is blurred by f^2 |1/s -
/// 1/focus| / N / (1 - f / focus). Reentrant. Error: a length that is not above 0, a camera inside
/// of the ball or nearer than the lens can focus, a target inside of the ball, a sensor without
/// pixels.
Result<Advice> advise(const Arrangement& arrangement);

}  // namespace orbwatch::align
