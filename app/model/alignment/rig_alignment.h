// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "proc/image/result.h"
#include "proc/optics/rig.h"

namespace orbwatch::app {

/// An alignment of one camera of a rig; members without a value stay as they are in the rig.
struct CameraAlignment {
  std::string camera;
  std::optional<optics::Outline> outline{};
  /// Belongs to the outline; excludes `pose`. None: unchanged, perhaps not registered.
  std::optional<optics::Mat3> registration{};
  std::optional<optics::Pose> pose{};  ///< replaces outline and registration
  std::optional<optics::Intrinsics> intrinsics{};
};

/// An alignment of a rig.
struct RigAlignment {
  std::optional<optics::Vec3> ball_centre{};  ///< machine frame, mm
  std::vector<CameraAlignment> cameras{};
};

/// Replaces the values of the rig; cameras that the rig does not have are ignored. Error: a camera
/// whose projection can no longer be made, a ball that the scene intersects.
Result<> apply(const RigAlignment& alignment, optics::Rig& rig);

}  // namespace orbwatch::app
