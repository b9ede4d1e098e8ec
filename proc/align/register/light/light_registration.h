// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "proc/align/register/registration.h"

namespace orbwatch::align {

/// Pictures of both cameras, the n-th of each taken at the same moment. Neither camera moves.
struct SimultaneousPictures {
  std::vector<Picture> reference;
  std::vector<Picture> camera;
};

/// Finds the sought camera's rotation to some degrees from the light of a process, sparks and melt
/// pool, that both see at the same moments; needs no start, and cameras may be of different
/// modality. The picture of `sought` is not used. A spark may be anywhere between the ball and the
/// scene; light that stays in one place counts once. Returns the rotations that explain the light
/// nearly as well as the best one, which comes first; they differ by 20 degrees at least, and edges
/// tell which is right. Takes a second. Reentrant. Error: too few moments with light, or too little
/// light that agrees.
Result<std::vector<Registration>> register_by_light(const SimultaneousPictures& pictures,
                                                    const optics::BallProjection& reference,
                                                    const SoughtCamera& sought);

}  // namespace orbwatch::align
