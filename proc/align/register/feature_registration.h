#pragma once

#include "proc/align/register/registration.h"

namespace orbwatch::align {

/// The sought camera's rotation from features that both pictures show (SIFT); needs no start. For
/// cameras of the same modality. Where the rig states no scene, how close the room is is estimated
/// along with the rotation, and counts in the covariance. Takes some seconds. Reentrant. Error: too
/// little in common, a rotation that another one rivals, one that is too uncertain.
Result<Registration> register_by_features(const ReferenceCamera& reference,
                                          const SoughtCamera& sought);

}  // namespace orbwatch::align
