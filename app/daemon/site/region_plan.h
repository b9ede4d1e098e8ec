// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "app/pipeline/measurement/recipe.h"
#include "app/pipeline/measurement/recipe_plan.h"
#include "app/pipeline/views/view_plan.h"
#include "proc/image/result.h"
#include "proc/signals/radiometry.h"
#include "proc/signals/region.h"

namespace orbwatch::app::daemon {

/// A recipe's region as it is measured in `view`, by a camera with this radiometry, in the camera's
/// counts. Limits of hot spots that it leaves open are those of assumed_limits(). Errors, with the
/// key: a threshold that no count of the camera reaches; an alarm on what never has a value.
/// Reentrant.
Result<pipeline::RegionPlan> plan_region(const pipeline::RegionOfInterest& region,
                                         const pipeline::ViewPlan& view,
                                         const signals::RadiometrySettings& radiometry,
                                         const signals::RegionScene& scene);

}  // namespace orbwatch::app::daemon
