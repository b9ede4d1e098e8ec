#pragma once

#include <vector>

#include "app/files/resolve.h"
#include "app/pipeline/pipeline.h"
#include "hal/camera.h"

namespace orbwatch::app {

/// Makes the pipeline's plan of a site, all but cameras, triggers and process inputs: the one place
/// where settings become objects. Compiles every recipe, so that each can be selected within a
/// frame. `formats`: by camera. Errors: what keeps files from running together although each is
/// right by itself; they name view, region or recipe.
Result<PipelinePlan> build(const Resolved& site, std::vector<hal::StreamFormat> formats);

/// Builds the site with the formats that its files state, and checks the keys for DDS. Opens no
/// camera and no line.
Result<> check_site(const Resolved& site);

}  // namespace orbwatch::app
