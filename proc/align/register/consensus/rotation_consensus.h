// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <vector>

#include "proc/align/register/features/feature_matches.h"
#include "proc/align/register/light/line_of_sight.h"
#include "proc/align/register/registration.h"

namespace orbwatch::align {

/// The rotation that most matches agree with.
struct RotationConsensus {
  optics::Mat3 rotation;
  std::vector<Match> inliers;
  std::size_t agreeing = 0;  ///< number of inliers within the expected accuracy
  std::size_t rival = 0;     ///< the same for the best rotation that is altogether different
  std::optional<RoomCloseness> room;  ///< set where no scene is stated: estimated from the inliers
};

/// RANSAC (Fischler and Bolles 1981) over pairs of matches. Each trial rotation moves the camera
/// around the ball, so that its sights are looked up in the scene anew; one for which the camera
/// has no projection is passed over. Reentrant; deterministic. Error: those of in_own_frame(),
/// fewer than two matches, no rotation that agrees with two.
Result<RotationConsensus> agree_on_rotation(const std::vector<Match>& matches,
                                            const optics::BallProjection& reference,
                                            const SoughtCamera& sought);

}  // namespace orbwatch::align
