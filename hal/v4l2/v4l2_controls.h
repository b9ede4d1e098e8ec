#pragma once

#include <string>
#include <string_view>

#include "hal/v4l2/v4l2_device.h"
#include "proc/image/result.h"

namespace orbwatch::hal {

/// A control's name as v4l2-ctl writes it: "Exposure Time, Absolute" is exposure_time_absolute.
std::string control_variable(std::string_view name);

/// True for the types that set_control() takes: a number, a truth, a menu's entry, a button.
bool takes_number(const v4l2_query_ext_ctrl& control);

/// Sets a control of a device by its V4L2 name in V4L2's units, case and signs in it aside
/// ("TriggerMode" is "Trigger Mode" and trigger_mode), or by a name of GenICam for one of V4L2:
/// ExposureTime in microseconds, Gain in the driver's units, GainAuto, ExposureAuto and
/// BalanceWhiteAuto as 0 (off) or 1 (on).
/// Values are rounded to whole units; any value presses a button. Errors: no such control (with the
/// list of those there are), not a number, read only, inactive (an automatism has it), out of
/// range, refused by the driver.
Result<> set_control(V4l2Device& device, std::string_view name, double value);

/// True when the control cannot be set now, because an automatism or another program has it. False
/// also when there is none of that name. Names as in set_control.
bool is_inactive(const V4l2Device& device, std::string_view name);

/// True for a control that does something once and holds no value. Names as in set_control.
bool is_button(const V4l2Device& device, std::string_view name);

/// True when the device has a control TriggerMode that is on: frames then come when triggered.
bool waits_for_trigger(const V4l2Device& device);

}  // namespace orbwatch::hal
