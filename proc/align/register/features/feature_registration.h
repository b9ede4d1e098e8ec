// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "proc/align/register/registration.h"
#include "proc/align/work_progress.h"

namespace orbwatch::align {

/// Finds the sought camera's rotation from features that both pictures show (SIFT); needs no start.
/// For cameras of the same modality. If the rig states no scene, the room's closeness is estimated
/// along with the rotation and included in the covariance. Takes some seconds. Reentrant. Error:
/// too little in common, a rotation that another one rivals, one that is too uncertain; cancelled
/// by `progress`.
Result<Registration> register_by_features(const ReferenceCamera& reference,
                                          const SoughtCamera& sought,
                                          const WorkProgress& progress = {});

}  // namespace orbwatch::align
