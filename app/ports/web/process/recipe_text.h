// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <vector>

#include "app/model/measured_recipe.h"
#include "proc/image/result.h"
#include "proc/signals/region.h"

namespace orbwatch::app::web {

/// Recipe as JSON: its views, regions with their corners and outlines in their views, and limits of
/// alarms; pixels are [u, v]. Reentrant.
std::string recipe_json(const MeasuredRecipe& recipe);

/// {"corners": [{"direction": [yaw, pitch], "point": [x, y, z] or null}, ...], "lines": [...]}: the
/// polygon whose corners a view shows at these pixels, in the recipe's coordinates; points are on
/// the scene's surface. Errors: the view shows nothing at a pixel; the corners do not form a
/// polygon. Reentrant.
Result<std::string> polygon_json(const optics::ViewProjection& view,
                                 const signals::RegionScene& scene,
                                 const std::vector<optics::Vec2>& pixels);

}  // namespace orbwatch::app::web
