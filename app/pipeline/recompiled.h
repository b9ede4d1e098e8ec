#pragma once

#include <cstddef>
#include <map>
#include <memory>
#include <vector>

#include "app/pipeline/measurement/compiled_recipe.h"
#include "app/pipeline/views/view_plan.h"
#include "hal/camera.h"

namespace orbwatch::app {

/// What is made anew for a camera that delivers another format than was guessed.
struct Recompiled {
  std::vector<hal::StreamFormat> formats;                  ///< by camera
  std::map<std::size_t, std::vector<ViewSource>> sources;  ///< of the display views that show it
  std::vector<std::unique_ptr<CompiledRecipe>> recipes;    ///< by index; null: not of this camera
};

}  // namespace orbwatch::app
