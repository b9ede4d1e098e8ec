// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <chrono>
#include <string>
#include <string_view>

#include "hal/v4l2/device/v4l2_device.h"
#include "proc/image/result.h"

namespace orbwatch::hal {

/// v4l2-ctl's name of a control: "Exposure Time, Absolute" is exposure_time_absolute.
std::string control_variable(std::string_view name);

/// True for the types that set_control() accepts: number, boolean, menu, button.
bool takes_number(const v4l2_query_ext_ctrl& control);

/// Finds a control by its name, as in set_control(). Error: there is none.
Result<v4l2_query_ext_ctrl> find_control(const V4l2Device& device, std::string_view name);

/// Sets a control by its V4L2 name in V4L2's units, regardless of case and punctuation
/// ("TriggerMode" is "Trigger Mode" and trigger_mode), or by a GenICam name: ExposureTime in
/// microseconds, Gain in the driver's units, GainAuto, ExposureAuto and BalanceWhiteAuto as 0 (off)
/// or 1 (on). Values are rounded to integers; any value presses a button. Errors: no such control
/// (with a list of the existing ones), not a number, read only, inactive (under automatic control),
/// out of range, refused by the driver.
Result<> set_control(V4l2Device& device, std::string_view name, double value);

/// True when the control cannot be set now: it is under automatic control, or another program
/// controls it. False for an unknown name. Names as in set_control.
bool is_inactive(const V4l2Device& device, std::string_view name);

/// True for a button, which has no value. Names as in set_control.
bool is_button(const V4l2Device& device, std::string_view name);

/// Exposure time that is set, as control ExposureTime; 0: unknown, such as under automatic control.
std::chrono::microseconds exposure_time(const V4l2Device& device);

/// True when the device's control TriggerMode is on: frames then arrive on triggers.
bool waits_for_trigger(const V4l2Device& device);

}  // namespace orbwatch::hal
