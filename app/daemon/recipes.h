#pragma once

#include <memory>
#include <vector>

#include "app/config/configuration.h"
#include "app/pipeline/compiled_recipe.h"
#include "hal/camera.h"

namespace orbwatch::app {

/// Compiles every recipe of the configuration, so that each can be selected within a frame.
/// `formats`: by camera. Errors name the recipe's file and say why.
Result<std::vector<std::unique_ptr<CompiledRecipe>>> compile_recipes(
    const Configuration& configuration, const std::vector<hal::StreamFormat>& formats);

}  // namespace orbwatch::app
