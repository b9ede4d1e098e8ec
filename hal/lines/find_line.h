// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "hal/lines/line.h"

namespace orbwatch::hal {

/// An existing line: pointers into the searched list of chips.
struct FoundLine {
  const ChipInfo* chip = nullptr;
  const LineInfo* line = nullptr;
};

/// Finds the line at `address`. Errors: no such line, with the named lines and the chips that could
/// not be opened; an ambiguous name or label.
Result<FoundLine> find_line(const std::vector<ChipInfo>& chips, const LineAddress& address);

/// The message for a failure to open `found` with the system's error `code` (errno).
std::string open_error(const FoundLine& found, const LineAddress& address, int code);

/// The reason why the device node `path` could not be opened, with the group that has permission.
std::string chip_error(const std::string& path, int code);

}  // namespace orbwatch::hal
