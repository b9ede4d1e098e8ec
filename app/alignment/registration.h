// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <chrono>
#include <optional>
#include <span>

#include "app/alignment/alignment_proposal.h"
#include "app/pictures/picture_copy.h"
#include "proc/align/register/camera_registration.h"
#include "proc/image/result.h"
#include "proc/optics/rig.h"

namespace orbwatch::app {

/// Pictures of two cameras that were taken at the same moment, to `window`; each at most once. Both
/// ascending in time, one at least of each. They point at the samples of the recorded ones.
/// Reentrant. Error: there are none.
Result<align::SimultaneousPictures> simultaneous(std::span<const RecordedPicture> reference,
                                                 std::span<const RecordedPicture> camera,
                                                 std::chrono::nanoseconds window);

/// A way to register a camera.
struct RegistrationSettings {
  align::RegistrationMethod method = align::RegistrationMethod::Auto;
  std::optional<optics::Outline> outline{};  ///< in place of the rig's
  double outline_sigma = 0;                  ///< see align::SoughtCamera::outline_sigma
  bool keeps_outline = false;                ///< see align::SoughtCamera::keeps_outline
};

/// A camera's registration, and the alignment that it amounts to.
struct FoundRegistration {
  align::CameraRegistration found;
  AlignmentProposal proposal;
};

/// Registers one camera of a rig to another one, whose alignment stands. `pictures`: as for
/// align::register_camera(). Reentrant. Error: those of optics::ball_projection() and
/// align::register_camera().
Result<FoundRegistration> register_camera(const optics::Rig& rig,
                                          const optics::RigCamera& reference,
                                          const optics::RigCamera& camera,
                                          const align::SimultaneousPictures& pictures,
                                          const RegistrationSettings& settings,
                                          const align::WorkProgress& progress);

/// The alignment of a registered camera: a pose that the rig states is kept as a pose, turned about
/// the ball; else it is the outline with the registration. `sought`: the camera by its outline.
/// Reentrant. Error: those of align::pose_of().
Result<CameraAlignment> registered_alignment(const optics::RigCamera& camera,
                                             const align::SoughtCamera& sought,
                                             const align::Registration& registration);

}  // namespace orbwatch::app
