// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <string_view>

#include "hal/genicam/genicam_settings.h"
#include "hal/libcamera/libcamera_settings.h"

namespace orbwatch::hal {

/// Back-ends that are modules, one per line. The module of NAME is the file camera-NAME.so in the
/// package orbwatch-camera-NAME.
inline constexpr std::array kModuleBackEnds{LibcameraSettings::kName, GenicamSettings::kName};

/// The module that opens videos for the back-end replay; file and package are named alike. Its
/// libraries take long to load, so it is loaded by the first video only.
inline constexpr std::string_view kVideoModule = "video";

}  // namespace orbwatch::hal
