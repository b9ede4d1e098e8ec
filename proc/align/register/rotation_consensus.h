#pragma once

#include <optional>
#include <vector>

#include "proc/align/register/feature_matches.h"
#include "proc/align/register/line_of_sight.h"
#include "proc/align/register/registration.h"

namespace orbwatch::align {

/// The rotation that most matches agree with.
struct RotationConsensus {
  optics::Mat3 rotation;
  std::vector<Match> inliers;
  std::size_t agreeing = 0;  ///< of the inliers: how many agree as exactly as they should
  std::size_t rival = 0;  ///< how many so agree with the best rotation that is altogether different
  std::optional<RoomCloseness> room;  ///< where no scene is stated: as the inliers tell it
};

/// RANSAC (Fischler and Bolles 1981) over pairs of matches. Each trial rotation moves the camera
/// around the ball, so that what it sees is looked up in the scene anew. Reentrant; the same for
/// the same matches. Error: those of optics::ball_projection, fewer than two matches.
Result<RotationConsensus> agree_on_rotation(const std::vector<Match>& matches,
                                            const optics::BallProjection& reference,
                                            const SoughtCamera& sought);

}  // namespace orbwatch::align
