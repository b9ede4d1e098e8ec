#pragma once

#include <libcamera/camera.h>

namespace orbwatch::hal {

/// True when a device node that the camera works through has vanished. Of libcamera's pipelines
/// only that of USB cameras notices; libcamera 0.4 ends the process by an assertion when another
/// camera is stopped or destroyed then, or comes back. False where libcamera names no nodes.
bool has_lost_its_nodes(const libcamera::Camera& camera);

}  // namespace orbwatch::hal
