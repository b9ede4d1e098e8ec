#pragma once

#include <tl/expected.hpp>

#include "hal/fault.h"

namespace orbwatch::hal {

/// A value of a device, or what the camera's user is told instead.
template <class T = void>
using DeviceResult = tl::expected<T, FaultReport>;

}  // namespace orbwatch::hal
