// SPDX-License-Identifier: Apache-2.0
#include "app/alignment/drift_correction.h"

#include "proc/align/register/registration.h"

namespace orbwatch::app {

std::optional<optics::Mat3> known_registration(const optics::RigCamera& camera) {
  return camera.is_registered ? std::optional(camera.registration) : std::nullopt;
}

Result<CameraAlignment> with_outline(const optics::Rig& rig, const optics::RigCamera& camera,
                                     const optics::Outline& outline) {
  return align::by_outline(rig, camera).map([&](const optics::RigCamera& seen) {
    return CameraAlignment{
        .camera = camera.name, .outline = outline, .registration = known_registration(seen)};
  });
}

Result<CameraAlignment> corrected(const optics::Rig& rig, const optics::RigCamera& camera,
                                  const align::DriftState& drift) {
  if (drift.is_learning) return fail("the zero of its drift is being learnt: wait some seconds");
  if (drift.level == align::DriftLevel::NotMeasured) {
    return fail("its drift is not measured: " + std::string(drift.reason));
  }
  if (!drift.turn) return with_outline(rig, camera, drift.outline);
  if (camera.pose) {
    const optics::Pose turned{*drift.turn * camera.pose->rotation, camera.pose->position};
    return CameraAlignment{.camera = camera.name, .pose = turned};
  }
  // The turn is about x right, y down, z forward; a registration is applied to X = -right,
  // Y = -forward, Z = -down.
  const optics::Mat3 axes = align::registration_of({});
  const optics::Mat3 turn = axes * align::registration_of(*drift.turn);
  CameraAlignment alignment{.camera = camera.name, .outline = drift.outline};
  if (camera.is_registered) alignment.registration = camera.registration * turn;
  return alignment;
}

}  // namespace orbwatch::app
