#pragma once

#include <array>
#include <optional>

#include "proc/image/picture.h"
#include "proc/image/result.h"
#include "proc/optics/ball_projection.h"
#include "proc/optics/rig.h"

namespace orbwatch::align {

/// The camera whose alignment stands: what it sees, and where that lies.
struct ReferenceCamera {
  Picture picture;
  optics::BallProjection ball;
};

/// The camera whose rotation is sought. Its outline in `camera` is right, its registration is the
/// start where a method needs one.
struct SoughtCamera {
  Picture picture;
  optics::Rig rig;  ///< ball and scene, as for the reference camera
  optics::RigCamera camera;
  /// Of the outline's centre and radius, as a share of the radius. Above 0 they are refined along
  /// with the rotation; 0: they stand.
  double outline_sigma = 0;
};

/// How a camera stands to the reference frame, and how sure that is.
struct Registration {
  optics::Mat3 rotation;    ///< v_reference = rotation v_camera
  optics::Outline outline;  ///< as given, or refined
  double residual = 0;      ///< degrees rms between what both see of the same thing
  double overlap = 0;       ///< share of all directions that both cameras show, [0, 1]
  int inliers = 0;          ///< things that both see
  optics::Mat3 covariance;  ///< of a small turn about the reference frame's axes, rad^2
};

/// Whether a rig tells where anything is; else the room is as unknown as the rotation.
bool states_scene(const optics::Rig& rig);

/// The standard deviations about the reference frame's axes, degrees.
std::array<double, 3> sigmas(const Registration& registration);

/// The camera as stated by outline and registration, where a rig may state a pose: it is the same
/// place, seen as a turn about the ball. Reentrant. Error: those of optics::ball_projection.
Result<optics::RigCamera> by_outline(const optics::Rig& rig, const optics::RigCamera& camera);

/// The pose of the sought camera as registered: about the ball, which its picture keeps where it
/// is. Needs intrinsics. Reentrant. Error: none, or an outline that is no ball's.
Result<optics::Pose> pose_of(const SoughtCamera& sought, const Registration& registration);

/// The registration that a pose's rotation amounts to. Reentrant.
optics::Mat3 registration_of(const optics::Mat3& pose_rotation);

/// The sought camera's projection as if `rotation` and `outline` were right. Reentrant.
Result<optics::BallProjection> turned(const SoughtCamera& sought, const optics::Mat3& rotation,
                                      const optics::Outline& outline);

/// The share of all directions that both cameras show within their pictures. Reentrant.
double overlap(const optics::BallProjection& a, int a_width, int a_height,
               const optics::BallProjection& b, int b_width, int b_height);

/// `registration` if it deserves trust. Error: too few inliers, little overlap, a covariance that
/// is too wide; the message says what to do.
Result<Registration> trusted(const Registration& registration, int least_inliers);

}  // namespace orbwatch::align
