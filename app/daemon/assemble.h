#pragma once

#include "app/config/configuration.h"
#include "app/daemon/lines.h"
#include "app/pipeline/pipeline.h"

namespace orbwatch::app {

/// Opens the cameras that the configuration names and plans the pipeline: the one place where
/// configuration becomes objects. `lines` are the open ones of the same configuration; they are
/// stopped before the plan's cameras go. Errors name the camera or view and say why.
Result<PipelinePlan> assemble(const Configuration& configuration, Lines& lines);

}  // namespace orbwatch::app
