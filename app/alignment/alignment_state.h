#pragma once

#include "app/model/alignment.h"
#include "proc/image/result.h"
#include "proc/optics/rig.h"

namespace orbwatch::app {

/// Where one of the rig's cameras stands and where its picture shows ball and scene; without how
/// that was found. Reentrant. Error: those of align::by_outline.
Result<CameraAlignmentState> alignment_state(const optics::Rig& rig,
                                             const optics::RigCamera& camera);

}  // namespace orbwatch::app
