// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "proc/align/register/registration.h"
#include "proc/image/result.h"
#include "proc/optics/scene_proxy.h"

namespace orbwatch::align {

/// A box on the floor that the room's description lacks: a table, for instance.
struct StandingBox {
  optics::Box box;  ///< like Scene::obstacles
  /// Significance of the cameras' better agreement, in standard deviations.
  double significance = 0;
};

/// Finds the box below the ball with which the edges of two registered cameras agree best. `scene`:
/// that of both projections, in whose frame Z points up; its room is a box. Takes some seconds.
/// Reentrant. Error: the room is not a box, or the pictures prove no box; one may be there all the
/// same.
Result<StandingBox> find_standing_box(const ReferenceCamera& first, const ReferenceCamera& second,
                                      const optics::Scene& scene);

}  // namespace orbwatch::align
