// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "hal/inventory.h"

namespace orbwatch::hal {

/// All cameras that answer, with their formats and features; those of a camera that another program
/// streams from may be unknown. Disturbs no stream. Takes seconds. Thread-safe.
std::vector<CameraEntry> list_genicam_cameras();

}  // namespace orbwatch::hal
