#pragma once

#include <vector>

#include "hal/inventory.h"

namespace orbwatch::hal {

/// Every camera that libcamera finds, with its modes for video and its controls; one entry that
/// says why, when libcamera does not start. Disturbs no camera that streams. libcamera's own log is
/// silent from then on. Thread-safe.
std::vector<CameraEntry> list_libcamera_cameras();

}  // namespace orbwatch::hal
