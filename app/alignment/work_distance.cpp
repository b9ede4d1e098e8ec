// SPDX-License-Identifier: Apache-2.0
#include "app/alignment/work_distance.h"

#include <cmath>
#include <limits>

namespace orbwatch::app {

double work_distance(const optics::Rig& rig, std::span<const optics::ViewSpec> measured_views) {
  double farthest = std::numeric_limits<double>::quiet_NaN();
  const auto scene = optics::SceneProxy::make(rig.scene, rig.ball);
  if (!scene) return farthest;
  for (const optics::ViewSpec& spec : measured_views) {
    const auto view = optics::ViewProjection::make(spec);
    const auto ahead =
        view ? view->direction((spec.width - 1) / 2.0, (spec.height - 1) / 2.0) : std::nullopt;
    const double closeness = ahead ? scene->hit(*ahead).closeness : 0;
    if (closeness > 0) farthest = std::fmax(farthest, rig.ball.radius / closeness);
  }
  return farthest;
}

}  // namespace orbwatch::app
