#pragma once

#include <string>
#include <vector>

#include "app/ports/lines/line_settings.h"
#include "hal/lines/line.h"

namespace orbwatch::app {

/// What became of one output.
struct SafeOutput {
  std::string name;
  std::string error;  ///< empty: it is inactive
};

/// Sets every output of the kernel's lines inactive and releases it: for the moment after the
/// process that had them was killed. Each is tried, whatever became of the others. Simulated lines
/// ended with their process. Waits for devices.
std::vector<SafeOutput> make_safe(const std::vector<LineSettings>& lines,
                                  hal::LineBackEnd& back_end);

}  // namespace orbwatch::app
