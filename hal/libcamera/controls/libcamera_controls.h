#pragma once

#include <libcamera/controls.h>

#include <string_view>
#include <vector>

#include "hal/inventory.h"
#include "proc/image/result.h"

namespace orbwatch::hal {

/// Puts a control into `list`, by libcamera's name and unit (ExposureTime in microseconds,
/// AnalogueGain, AeEnable and other switches as 0 or 1, LensPosition in dioptres, ...) or by a
/// GenICam name: Gain, ExposureAuto, BalanceWhiteAuto. ColourGains[0] and ColourGains[1] are the
/// gains of red and blue; one that was never set is 1. Values of integer controls are rounded.
/// Errors: no such control in `offered` (with a list of the existing ones), not a number, out of
/// range.
Result<> put_control(const libcamera::ControlInfoMap& offered, std::string_view name, double value,
                     libcamera::ControlList& list);

/// libcamera's id of the control `name`, as in put_control(), or nullptr.
const libcamera::ControlId* find_control(const libcamera::ControlInfoMap& offered,
                                         std::string_view name);

/// The controls of put_control(), by name.
std::vector<CameraControl> list_controls(const libcamera::ControlInfoMap& offered);

}  // namespace orbwatch::hal
