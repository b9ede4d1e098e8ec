// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "proc/align/register/registration.h"
#include "proc/align/work_progress.h"

namespace orbwatch::align {

/// Finds the sought camera's rotation from edges that both pictures show, also for cameras of
/// different modality, such as colour and thermal. Starts from its registration in the rig, which
/// must be accurate to kGradientReach. The outline is refined along with the rotation, from one
/// that is right to about a pixel, and is part of the covariance. Takes some seconds. Reentrant.
/// Error: edges that do not agree anywhere near it, two rotations that fit nearly as well, a
/// rotation that is too uncertain; cancelled by `progress`.
Result<Registration> register_by_gradients(const ReferenceCamera& reference,
                                           const SoughtCamera& sought,
                                           const WorkProgress& progress = {});

inline constexpr double kGradientReach = 9;  ///< degrees

}  // namespace orbwatch::align
