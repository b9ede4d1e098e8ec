// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <functional>
#include <optional>
#include <string>

#include "app/alignment/alignment_proposal.h"
#include "proc/image/result.h"
#include "proc/optics/rig.h"

namespace orbwatch::app {

/// Changes the outline and, if the camera is registered, its registration.
using AlignmentChange =
    std::function<void(optics::Outline& outline, std::optional<optics::Mat3>& registration)>;

/// The alignment of a rig's camera with a change that a user states. `method` names it. Reentrant.
/// Error: an alignment that cannot be.
Result<AlignmentProposal> stated_alignment(optics::Rig rig, const optics::RigCamera& camera,
                                           const std::string& method,
                                           const AlignmentChange& change);

}  // namespace orbwatch::app
