#pragma once

#include <libcamera/camera.h>

namespace orbwatch::hal {

/// True when a device node of the camera has vanished. Only libcamera's pipeline of USB cameras
/// detects that; libcamera 0.4 aborts the process when such a camera of another pipeline is
/// stopped, destroyed or connected again. False where libcamera lists no nodes.
bool has_lost_its_nodes(const libcamera::Camera& camera);

}  // namespace orbwatch::hal
