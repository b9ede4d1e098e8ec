// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <vector>

#include "app/ports/lines/line_settings.h"
#include "hal/lines/line.h"

namespace orbwatch::app {

/// Outcome for one output.
struct SafeOutput {
  std::string name;
  std::string error;  ///< empty: the output is inactive
};

/// Sets every output of the kernel's lines inactive and releases it, for use after the process that
/// held them was killed. Each output is tried, regardless of failures of others. Simulated lines
/// ended with their process. Waits for devices.
std::vector<SafeOutput> make_safe(const std::vector<LineSettings>& lines,
                                  hal::LineBackEnd& back_end);

}  // namespace orbwatch::app
