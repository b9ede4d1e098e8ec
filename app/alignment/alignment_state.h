// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <optional>

#include "app/alignment/aligned_site.h"
#include "app/model/alignment/alignment.h"
#include "proc/image/result.h"
#include "proc/optics/rig.h"

namespace orbwatch::app {

/// Place of one of the rig's cameras, and of ball and scene in its picture; without the method by
/// which it was found. Reentrant. Error: those of align::by_outline.
Result<CameraAlignmentState> alignment_state(const optics::Rig& rig,
                                             const optics::RigCamera& camera);

/// The camera's alignment in force, with number, method and quality if it was accepted. Nullopt:
/// alignment_state() fails. Reentrant.
std::optional<CameraAlignmentState> alignment_in_force(const AlignedSite& site, std::size_t camera);

}  // namespace orbwatch::app
