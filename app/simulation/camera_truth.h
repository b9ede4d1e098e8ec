#pragma once

#include <array>

#include "app/simulation/tracing/pinhole.h"

namespace orbwatch::app::simulation {

/// The ball's silhouette in a picture whose camera looks at the ball's centre: a circle, in pixels.
struct BallOutline {
  double cx = 0;
  double cy = 0;
  double radius = 0;
};

/// What alignment should find for a simulated camera that looks at the ball's centre; exact, from
/// geometry alone.
struct CameraTruth {
  BallOutline outline;
  double alpha = 0;  ///< degrees, the reflected field of view: 360 - 2 asin(ball radius / distance)

  /// By rows: v_machine = rotation v_camera, where v_camera is a direction in the frame of a photo
  /// with no calibration (the camera sits on +Y of the ball and looks along -Y, up is +Z).
  std::array<double, 9> rotation{};

  /// The same in degrees: rotation = yaw pitch roll, intrinsic. Yaw about Z, +Y towards +X
  /// positive; pitch about the new X, up positive; roll about the new Y, right side down positive.
  double yaw = 0;
  double pitch = 0;
  double roll = 0;
};

/// Reentrant.
CameraTruth truth_of(const Pinhole& camera, const Sphere& ball);

}  // namespace orbwatch::app::simulation
