// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <memory>
#include <utility>

#include "app/pipeline/measurement/compiled_recipe.h"

namespace orbwatch::app::pipeline {

/// Recipe with one view, the first source of which is measured, and one region that covers all of
/// it. The geometry of the machine is unknown.
inline RecipePlan recipe_plan(ViewPlan view, double hot_spot_threshold, double kelvin_per_count = 0,
                              std::uint16_t number = 1) {
  signals::RegionSettings region;
  region.hot_spot_threshold = hot_spot_threshold;
  region.radiometry.kelvin_per_count = kelvin_per_count;
  if (view.sources[0].format.format != PixelFormat::Y16) region.full_scale = 255;
  view.measured = 0;
  RecipePlan plan;
  plan.number = number;
  plan.views.push_back(std::move(view));
  plan.regions.push_back({"all", 0, std::move(region)});
  return plan;
}

inline std::unique_ptr<CompiledRecipe> compiled(RecipePlan plan) {
  return CompiledRecipe::make(std::move(plan), {}).value();
}

}  // namespace orbwatch::app::pipeline
