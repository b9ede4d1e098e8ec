// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "hal/fault.h"
#include "hal/genicam/device/aravis.h"
#include "hal/genicam/device/found_camera.h"

namespace orbwatch::hal {

/// Opens a camera and takes control of it. Faults: it does not answer, another host or program has
/// control of it, its description of itself is unusable. Thread-safe.
DeviceResult<OwnedObject<ArvCamera>> open_camera(const FoundCamera& found);

}  // namespace orbwatch::hal
