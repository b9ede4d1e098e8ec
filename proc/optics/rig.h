// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "proc/image/result.h"
#include "proc/optics/ball_projection.h"
#include "proc/optics/rotation.h"

namespace orbwatch::optics {

/// One camera of a rig, as stated by a file or an alignment. Its position follows from
/// - intrinsics and pose, or
/// - intrinsics, outline and registration: the ball's direction and distance follow from the limb;
///   the registration turns the camera's own axes (X = -right, Y = -forward, Z = -down), or
/// - outline, registration, and alpha or distance: a camera without calibration.
struct RigCamera {
  std::string name;
  int width = 0;  ///< px, size of the pictures that all members refer to
  int height = 0;
  BallModel::Kind model = BallModel::Kind::Exact;
  std::optional<Intrinsics> intrinsics;
  std::optional<Pose> pose;
  std::optional<Outline> outline;
  std::optional<double> alpha;     ///< degrees
  std::optional<double> distance;  ///< ball radii
  Mat3 registration;
  bool is_registered = true;     ///< false: the registration is not known yet
  std::optional<Window> window;  ///< needs intrinsics
};

/// The known geometry, as written by alignment.
struct Rig {
  Ball ball;
  Scene scene;
  std::vector<RigCamera> cameras;
};

/// The projection of one of the rig's cameras. Error: missing, superfluous or impossible members;
/// the message begins with the camera's name.
Result<BallProjection> ball_projection(const Rig& rig, const RigCamera& camera);

/// True for a camera with neither pose nor outline, which is still to be placed. Reentrant.
bool is_unplaced(const RigCamera& camera);

/// Checks the members of an unplaced camera. Reentrant. Error: as ball_projection().
Result<> check_unplaced(const RigCamera& camera);

}  // namespace orbwatch::optics
