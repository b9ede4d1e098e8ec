// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <chrono>
#include <string>
#include <string_view>
#include <vector>

#include "hal/genicam/device/aravis.h"
#include "hal/inventory.h"
#include "proc/image/result.h"

namespace orbwatch::hal {

/// Sets a feature by its GenICam name in its own unit (SFNC: ExposureTime in microseconds, Gain in
/// dB, ...). Integers are rounded; switches take 0 and 1; a menu takes the number of an entry, but
/// a menu whose name ends in Auto takes 0 (Off) and 1 (Continuous); any value executes a command.
/// TriggerMode 1 makes the camera wait for `trigger_source`, 0 lets it run freely. ExposureTime and
/// Gain also name the equivalents of older cameras.
/// Errors: no such feature, not a number, read only, not available now, outside of the limits that
/// the camera states now, refused by the camera.
Result<> set_feature(ArvCamera* camera, const std::string& name, double value,
                     const std::string& trigger_source);

/// Features that set_feature() accepts, by name.
std::vector<CameraControl> list_features(ArvCamera* camera);

/// Exposure time that is set; 0: unknown, such as under automatic control.
std::chrono::microseconds exposure_time(ArvCamera* camera);

/// True when frames arrive on triggers.
bool waits_for_trigger(ArvCamera* camera);

}  // namespace orbwatch::hal
