// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "app/model/alignment/alignment.h"
#include "proc/image/result.h"
#include "proc/optics/rig.h"

namespace orbwatch::app {

/// Place of one of the rig's cameras, and of ball and scene in its picture; without the method by
/// which it was found. Reentrant. Error: those of align::by_outline.
Result<CameraAlignmentState> alignment_state(const optics::Rig& rig,
                                             const optics::RigCamera& camera);

}  // namespace orbwatch::app
