#pragma once

#include "app/config/configuration.h"
#include "app/pipeline/pipeline.h"

namespace orbwatch::app {

/// Opens the cameras that the configuration names and plans the pipeline: the one place where
/// configuration becomes objects. Errors name the camera or view and say why.
Result<PipelinePlan> assemble(const Configuration& configuration);

}  // namespace orbwatch::app
