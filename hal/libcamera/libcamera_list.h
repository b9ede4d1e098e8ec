// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "hal/inventory.h"

namespace orbwatch::hal {

/// All cameras of libcamera, with their video modes and controls; one entry with the reason when
/// libcamera does not start. Disturbs no stream. Silences libcamera's own log. Thread-safe.
std::vector<CameraEntry> list_libcamera_cameras();

}  // namespace orbwatch::hal
