// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <span>
#include <string>

#include "hal/v4l2/device/v4l2_device.h"

namespace orbwatch::hal {

/// Advice on configuring a thermal camera whose offered format and sizes reveal that its frames
/// differ from their declared format: 16 bit words as YUYV below a picture, or lines of telemetry
/// beside it. Empty for other sizes. Reentrant.
std::string thermal_advice(std::uint32_t fourcc, std::span<const FrameSizeOffer> sizes);

}  // namespace orbwatch::hal
