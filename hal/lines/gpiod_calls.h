#pragma once

#include <memory>
#include <string>
#include <tl/expected.hpp>
#include <vector>

#include "hal/lines/line_back_end.h"

/// The calls of libgpiod that differ between its generations: gpiod1_calls.cpp and
/// gpiod2_calls.cpp implement them, and the build takes the one that fits the library.
/// Errors are the system's numbers (errno).
namespace orbwatch::hal::gpiod_calls {

/// Label and lines of the chip at `path`.
tl::expected<ChipInfo, int> read_chip(const std::string& path);

tl::expected<std::unique_ptr<DigitalInput>, int> request_input(const std::string& path,
                                                               unsigned offset,
                                                               const InputSettings& settings);

tl::expected<std::unique_ptr<DigitalOutput>, int> request_output(const std::string& path,
                                                                 unsigned offset,
                                                                 const OutputSettings& settings);

/// The fault that a failed call on an open line of `text` means.
LineFaultReport line_fault(const std::string& text, int code);

/// Makes reads from the descriptor of a line return at once when nothing is there.
bool never_wait(int descriptor);

}  // namespace orbwatch::hal::gpiod_calls
