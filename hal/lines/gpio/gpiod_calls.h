// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <memory>
#include <string>
#include <tl/expected.hpp>
#include <vector>

#include "hal/lines/line.h"

/// Calls that differ between libgpiod 1.6 (gpiod1_calls.cpp) and 2.x (gpiod2_calls.cpp); the build
/// selects one by the library's version. Errors are values of errno.
namespace orbwatch::hal::gpiod_calls {

/// Label and lines of the chip at `path`.
tl::expected<ChipInfo, int> read_chip(const std::string& path);

tl::expected<std::unique_ptr<DigitalInput>, int> request_input(const std::string& path,
                                                               unsigned offset,
                                                               const InputSettings& settings);

tl::expected<std::unique_ptr<DigitalOutput>, int> request_output(const std::string& path,
                                                                 unsigned offset,
                                                                 const OutputSettings& settings);

/// Fault of a failed call on the open line `text`.
LineFaultReport line_fault(const std::string& text, int code);

/// Makes reads from a line's descriptor non-blocking. False: errno has the reason.
bool never_wait(int descriptor);

}  // namespace orbwatch::hal::gpiod_calls
