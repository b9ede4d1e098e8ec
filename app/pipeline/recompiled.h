// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <map>
#include <memory>
#include <vector>

#include "app/pipeline/measurement/compiled_recipe.h"
#include "app/pipeline/views/view_plan.h"
#include "hal/camera.h"

namespace orbwatch::app::pipeline {

/// Objects made anew for a camera whose format differs from the assumed one.
struct Recompiled {
  std::vector<hal::StreamFormat> formats;  ///< format of each camera
  std::map<std::size_t, std::vector<ViewSource>>
      sources;  ///< sources of the display views that show it
  std::vector<std::unique_ptr<CompiledRecipe>>
      recipes;  ///< one per index; null: does not use this camera
};

}  // namespace orbwatch::app::pipeline
