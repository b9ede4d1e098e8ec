#pragma once

#include <vector>

#include "proc/align/register/feature_matches.h"
#include "proc/align/register/registration.h"

namespace orbwatch::align {

/// A rotation, and the outline when the sought camera's is unsure, by robust least squares over
/// matches: the angles between what both cameras see, through the scene, weighted by both
/// resolutions. Reentrant.
struct RotationRefinement {
  optics::Mat3 rotation;
  optics::Outline outline;
  optics::Mat3 covariance;  ///< as Registration's
  double residual = 0;      ///< degrees rms of the matches that fit
  int inliers = 0;          ///< matches that fit
};

/// Starts from `rotation` and `outline`. Error: those of optics::ball_projection, matches that do
/// not determine the rotation.
Result<RotationRefinement> refine_rotation(const std::vector<Match>& matches,
                                           const optics::BallProjection& reference,
                                           const SoughtCamera& sought, const optics::Mat3& rotation,
                                           const optics::Outline& outline);

}  // namespace orbwatch::align
