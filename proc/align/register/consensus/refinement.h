// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "proc/align/register/consensus/refinement_trial.h"
#include "proc/align/register/features/feature_matches.h"
#include "proc/align/register/registration.h"

namespace orbwatch::align {

/// A rotation, the outline when the sought camera's is uncertain, and the room's closeness where no
/// scene is stated, by robust least squares over matches: the angles between both cameras' sights,
/// through the scene, weighted by both resolutions. Reentrant.
struct RotationRefinement {
  RefinementState state;
  optics::Mat3 covariance;  ///< like Registration's
  double residual = 0;      ///< degrees rms of the matches that fit
  int inliers = 0;          ///< matches that fit
};

/// The closeness of a match in an unstated room follows from its own sights and from all others:
/// the mean is an unknown, the spread follows from the result. Error: those of
/// optics::ball_projection, matches that do not determine the rotation.
Result<RotationRefinement> refine_rotation(const std::vector<Match>& matches,
                                           const optics::BallProjection& reference,
                                           const SoughtCamera& sought,
                                           const RefinementState& start);

}  // namespace orbwatch::align
