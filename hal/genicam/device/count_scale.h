#pragma once

#include <optional>
#include <string_view>

#include "hal/camera.h"
#include "hal/genicam/device/aravis.h"

namespace orbwatch::hal {

/// What the features of a thermal camera say of its counts now, in pictures of this format, one of
/// kGenicamFormats; nullopt: nothing.
std::optional<CountScale> read_count_scale(ArvCamera* camera, std::string_view pixel_format);

/// Whether `feature` is one of those, and has another value now: to set it would change the scale.
bool would_rescale(ArvCamera* camera, std::string_view feature, double value);

}  // namespace orbwatch::hal
