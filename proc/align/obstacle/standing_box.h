#pragma once

#include "proc/align/register/registration.h"
#include "proc/image/result.h"
#include "proc/optics/scene_proxy.h"

namespace orbwatch::align {

/// A box on the floor of a room that nobody has stated: a table, for instance.
struct StandingBox {
  optics::Box box;          ///< as Scene::obstacles
  double significance = 0;  ///< of the cameras' better agreement, in standard deviations
};

/// Looks for the one below the ball by which the edges that two registered cameras see agree best.
/// `scene`: that of both projections, in whose frame Z points up; its room is a box. Takes some
/// seconds. Reentrant. Error: no such room, or none that the pictures prove; that it is there all
/// the same is not excluded.
Result<StandingBox> find_standing_box(const ReferenceCamera& first, const ReferenceCamera& second,
                                      const optics::Scene& scene);

}  // namespace orbwatch::align
