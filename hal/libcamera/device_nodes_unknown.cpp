#include "hal/libcamera/device_nodes.h"

/// libcamera before 0.2 does not list a camera's nodes.
namespace orbwatch::hal {

bool has_lost_its_nodes(const libcamera::Camera&) { return false; }

}  // namespace orbwatch::hal
