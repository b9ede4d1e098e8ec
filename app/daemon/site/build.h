// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <vector>

#include "app/daemon/site/site_plan.h"
#include "app/files/resolve.h"
#include "app/pipeline/pipeline.h"
#include "hal/camera.h"

namespace orbwatch::app::daemon {

/// Makes the pipeline's plan of a site, all but cameras, triggers and process inputs. Compiles
/// every recipe, so that each can be selected within a frame. Error, with the recipe's file: a
/// region that cannot be measured, see CompiledRecipe::make().
Result<pipeline::PipelinePlan> build(const files::Resolved& site, const SitePlan& plan);

/// Makes those parts of the pipeline's plan anew that use `camera`, which came with another format
/// than was expected. `formats`: by camera. Errors: as SitePlan::make() and build().
Result<pipeline::Recompiled> rebuild(const files::Resolved& site,
                                     std::vector<hal::StreamFormat> formats, std::size_t camera);

}  // namespace orbwatch::app::daemon
