#pragma once

#include <vector>

#include "hal/inventory.h"

namespace orbwatch::hal {

/// Every camera that answers, with its formats and features; those of a camera that another
/// program streams from may be unknown. Disturbs no stream. Takes seconds. Thread-safe.
std::vector<CameraEntry> list_genicam_cameras();

}  // namespace orbwatch::hal
