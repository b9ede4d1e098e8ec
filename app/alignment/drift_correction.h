// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>

#include "app/model/alignment/rig_alignment.h"
#include "proc/align/drift/drift_monitor.h"
#include "proc/image/result.h"
#include "proc/optics/rig.h"

namespace orbwatch::app {

/// The alignment that a camera has after its drift: one that turned about its own centre looks
/// elsewhere, else the ball is elsewhere in its picture, and a camera whose picture rolled is
/// rolled about the line to the ball. `rig`: the one in force, which the drift is measured against.
/// Reentrant. Error: nothing was measured, the zero is being learnt; those of align::by_outline.
Result<CameraAlignment> corrected(const optics::Rig& rig, const optics::RigCamera& camera,
                                  const align::DriftState& drift);

/// The registration of a camera that is stated by its outline; nullopt: it is not registered.
std::optional<optics::Mat3> known_registration(const optics::RigCamera& camera);

/// The alignment of a camera that sees the ball elsewhere and is turned as before. Reentrant.
/// Error: those of align::by_outline.
Result<CameraAlignment> with_outline(const optics::Rig& rig, const optics::RigCamera& camera,
                                     const optics::Outline& outline);

}  // namespace orbwatch::app
