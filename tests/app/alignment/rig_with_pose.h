// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "proc/optics/rig.h"

namespace orbwatch::app::tests {

/// A ball of 50 mm radius and a camera at `position`, some 600 mm before it, that looks forward.
inline optics::Rig rig_with_pose(const optics::Vec3& position) {
  optics::Rig rig;
  rig.ball = {{120, 60, 430}, 50};
  optics::RigCamera camera;
  camera.name = "a";
  camera.width = camera.height = 800;
  camera.intrinsics = optics::Intrinsics{800, 800, 4200, 4200, 399.5, 399.5, {}, {}};
  camera.pose = optics::Pose{{{1, 0, 0}, {0, 0, -1}, {0, 1, 0}}, position};
  rig.cameras.push_back(camera);
  return rig;
}

}  // namespace orbwatch::app::tests
