#pragma once

#include <optional>
#include <string>
#include <vector>

#include "proc/image/result.h"
#include "proc/optics/rig.h"

namespace orbwatch::app {

/// Result of an alignment for a camera of a rig; other values are kept.
struct CameraAlignment {
  std::string camera;
  std::optional<optics::Outline> outline{};
  /// Belongs to the outline; excludes `pose`. None: unchanged, perhaps not registered.
  std::optional<optics::Mat3> registration{};
  std::optional<optics::Pose> pose{};  ///< replaces outline and registration
  std::optional<optics::Intrinsics> intrinsics{};
};

/// Result of an alignment for a rig.
struct RigAlignment {
  std::optional<optics::Vec3> ball_centre{};  ///< machine frame, mm
  std::vector<CameraAlignment> cameras{};
};

/// Replaces the values of the rig; cameras that the rig does not have are ignored. Error: a camera
/// whose projection can no longer be made, a ball that the scene intersects.
Result<> apply(const RigAlignment& alignment, optics::Rig& rig);

}  // namespace orbwatch::app
