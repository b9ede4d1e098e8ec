// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <string_view>

#include "hal/camera.h"
#include "hal/genicam/device/aravis.h"

namespace orbwatch::hal {

/// Count scale that the present features of a thermal camera state for pictures of this format, one
/// of kGenicamFormats; nullopt: none.
std::optional<CountScale> read_count_scale(ArvCamera* camera, std::string_view pixel_format);

/// True if `feature` determines the scale and has another value now: setting it would change the
/// scale.
bool would_rescale(ArvCamera* camera, std::string_view feature, double value);

}  // namespace orbwatch::hal
