// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <optional>

#include "proc/image/picture.h"
#include "proc/image/result.h"
#include "proc/optics/ball_projection.h"
#include "proc/optics/rig.h"

namespace orbwatch::align {

/// The camera whose alignment is accepted: its picture and its projection.
struct ReferenceCamera {
  Picture picture;
  optics::BallProjection ball;
};

/// The camera whose rotation is sought. Its outline in `camera` is right, to a fraction of a pixel
/// for gradients; its registration is the start where a method needs one.
struct SoughtCamera {
  Picture picture;
  optics::Rig rig;  ///< ball and scene, the same as the reference camera's
  optics::RigCamera camera;
  /// Standard deviation of the outline's centre and radius, as a share of the radius. Above 0
  /// features refine them along with the rotation; 0: they keep them. Gradients refine them unless
  /// keeps_outline is set, see kOutlinePrior.
  double outline_sigma = 0;
  /// For gradients, where the scene lacks something that is sought afterwards: a refined outline
  /// would take up a part of its parallax.
  bool keeps_outline = false;
};

/// A camera's rotation relative to the reference frame, and its accuracy.
struct Registration {
  optics::Mat3 rotation;    ///< v_reference = rotation v_camera
  optics::Outline outline;  ///< the given outline, or the refined one
  double residual = 0;      ///< degrees rms between both cameras' sights of the same thing
  double overlap = 0;       ///< share of all directions that both cameras show, [0, 1]
  int inliers = 0;          ///< number of things that both see
  optics::Mat3 covariance;  ///< covariance of a small turn about the reference frame's axes, rad^2
};

/// True if a rig states a room or obstacles; else the room is as unknown as the rotation.
bool states_scene(const optics::Rig& rig);

/// The standard deviations about the reference frame's axes, degrees.
std::array<double, 3> sigmas(const Registration& registration);

/// Degrees: the rms error of a direction that the camera shows, over all directions. Reentrant.
double direction_sigma(const Registration& registration);

/// The camera stated by outline and registration instead of the rig's pose: the same place,
/// expressed as a turn about the ball. Reentrant. Error: those of optics::ball_projection.
Result<optics::RigCamera> by_outline(const optics::Rig& rig, const optics::RigCamera& camera);

/// The registered pose of the sought camera: turned about the ball, whose picture stays in place.
/// Needs intrinsics. Reentrant. Error: no intrinsics, or an outline that is not a ball's.
Result<optics::Pose> pose_of(const SoughtCamera& sought, const Registration& registration);

/// The registration equivalent to a pose's rotation. Reentrant.
optics::Mat3 registration_of(const optics::Mat3& pose_rotation);

/// The sought camera's projection for an assumed `rotation` and `outline`. Reentrant.
Result<optics::BallProjection> turned(const SoughtCamera& sought, const optics::Mat3& rotation,
                                      const optics::Outline& outline);

/// The sought camera's projection by its outline alone, in the camera's own frame: where a search
/// starts that knows no rotation. Without its window, whose normal is of the machine frame and thus
/// unknown in the camera's; the turned() camera has it. Reentrant.
Result<optics::BallProjection> in_own_frame(const SoughtCamera& sought);

/// The share of all directions that both cameras show within their pictures. Reentrant.
double overlap(const optics::BallProjection& a, int a_width, int a_height,
               const optics::BallProjection& b, int b_width, int b_height);

/// Returns `registration` if it is reliable. Error: too few inliers, little overlap, a covariance
/// that is too wide; the message contains the remedy.
Result<Registration> trusted(const Registration& registration, int least_inliers);

}  // namespace orbwatch::align
