#pragma once

#include <libcamera/controls.h>

#include <string_view>
#include <vector>

#include "hal/inventory.h"
#include "proc/image/result.h"

namespace orbwatch::hal {

/// Puts a control into `list`, by libcamera's name and in libcamera's unit: ExposureTime in
/// microseconds, AnalogueGain, AeEnable and other switches as 0 or 1, LensPosition in dioptres,
/// ...; or by a name of GenICam: Gain, ExposureAuto, BalanceWhiteAuto. ColourGains[0] and
/// ColourGains[1] are the gains of red and blue; the one that was never set is 1. Whole numbers are
/// rounded. Errors: `offered` has no such control (with the list of those there are), does not take
/// a number, out of its range.
Result<> put_control(const libcamera::ControlInfoMap& offered, std::string_view name, double value,
                     libcamera::ControlList& list);

/// libcamera's id of the control that `name` names as in put_control(), or nullptr.
const libcamera::ControlId* find_control(const libcamera::ControlInfoMap& offered,
                                         std::string_view name);

/// What put_control() takes, by name.
std::vector<CameraControl> list_controls(const libcamera::ControlInfoMap& offered);

}  // namespace orbwatch::hal
