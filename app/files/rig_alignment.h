#pragma once

#include <optional>
#include <string>
#include <vector>

#include "proc/image/result.h"
#include "proc/optics/rig.h"

namespace orbwatch::app {

/// What an alignment found out about a camera of a rig; the rest stays.
struct CameraAlignment {
  std::string camera;
  std::optional<optics::Outline> outline{};
  /// Belongs to the outline; excludes `pose`. None: as before, perhaps not registered.
  std::optional<optics::Mat3> registration{};
  std::optional<optics::Pose> pose{};  ///< instead of outline and registration
  std::optional<optics::Intrinsics> intrinsics{};
};

/// What an alignment found out about a rig.
struct RigAlignment {
  std::optional<optics::Vec3> ball_centre{};  ///< machine frame, mm
  std::vector<CameraAlignment> cameras{};
};

/// Puts it in the place of what the rig had; cameras that the rig does not have are ignored. Error:
/// a camera whose projection cannot be made any more, a ball that the scene cuts.
Result<> apply(const RigAlignment& alignment, optics::Rig& rig);

}  // namespace orbwatch::app
