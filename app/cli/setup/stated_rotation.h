// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "proc/image/result.h"
#include "proc/optics/vec.h"

namespace orbwatch::app::cli {

/// A rotation that a user stated with a few decimals.
struct StatedRotation {
  optics::Mat3 rotation;
  double change = 0;  ///< degrees by which the axis that changed most was turned; 0: as stated
};

/// `matrix` as it is if it is a rotation to 1e-6, or else the nearest rotation. Reentrant. Error:
/// further from it than four decimals explain.
Result<StatedRotation> stated_rotation(const optics::Mat3& matrix);

}  // namespace orbwatch::app::cli
