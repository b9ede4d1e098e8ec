// SPDX-License-Identifier: Apache-2.0
#include "app/alignment/drift_correction.h"

#include <cmath>
#include <utility>

#include "proc/align/register/registration.h"
#include "proc/align/rotation_fit.h"

namespace orbwatch::app {
namespace {

/// Rolls a registered camera as its picture has rolled: about the line to the ball, which the
/// outline shows. `moved`: its alignment with the outline after the motion. Error: those of
/// optics::ball_projection.
Result<CameraAlignment> rolled(const optics::Rig& rig, const optics::RigCamera& camera,
                               CameraAlignment moved, const align::PictureMotion& motion) {
  if (!moved.registration) return moved;
  optics::RigCamera seen = camera;
  seen.pose.reset();
  seen.outline = moved.outline;
  seen.registration = *moved.registration;
  return optics::ball_projection(rig, seen).map([&](const optics::BallProjection& ball) {
    const double roll = std::atan2(motion.roll, 1 + motion.growth);
    // A camera turns against its picture: from u towards v is right-handed along the sight, the
    // camera's turn along the way back.
    moved.registration = align::rotation_about(ball.facing() * roll) * *moved.registration;
    return moved;
  });
}

}  // namespace

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
  if (!drift.turn) {
    return with_outline(rig, camera, drift.outline).and_then([&](CameraAlignment moved) {
      return rolled(rig, camera, std::move(moved), drift.motion);
    });
  }
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
