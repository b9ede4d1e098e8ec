#pragma once

#include <string>
#include <string_view>

#include "hal/v4l2/v4l2_device.h"
#include "proc/image/result.h"

namespace orbwatch::hal {

/// A control's name as v4l2-ctl writes it: "Exposure Time, Absolute" is exposure_time_absolute.
std::string control_variable(std::string_view name);

/// Sets a control of a device by its V4L2 name, in either spelling and in V4L2's units, or by a
/// name of GenICam: ExposureTime in microseconds, Gain in the driver's units. Values are rounded to
/// whole units. Errors: no such control (with the list of those there are), not a number, read
/// only, inactive (an automatism has it), out of range, refused by the driver.
Result<> set_control(V4l2Device& device, std::string_view name, double value);

/// True when the control cannot be set now, because an automatism or another program has it. False
/// also when there is none of that name. Names as in set_control.
bool is_inactive(const V4l2Device& device, std::string_view name);

}  // namespace orbwatch::hal
