// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>

#include "proc/align/drift/picture_motion.h"
#include "proc/optics/lens.h"

namespace orbwatch::align {

/// The rotation of a camera about its own centre that causes this motion of the ball's picture: a
/// ray of its frame has the coordinates R ray after the turn. Least squares over the ball's rays
/// (Kabsch, 1976). nullopt when the lens does not show them. Reentrant.
std::optional<optics::Mat3> camera_turn(const optics::Lens& lens, const optics::Outline& outline,
                                        const PictureMotion& motion);

}  // namespace orbwatch::align
