#pragma once

#include <vector>

#include "hal/lines/line_back_end.h"

namespace orbwatch::hal {

/// A line that exists: pointers into the list of chips it was found in.
struct FoundLine {
  const ChipInfo* chip = nullptr;
  const LineInfo* line = nullptr;
};

/// The line at `address`. Errors: none there, with the lines that have names and the chips that
/// could not be opened; two of that name or label.
Result<FoundLine> find_line(const std::vector<ChipInfo>& chips, const LineAddress& address);

/// What to tell when opening `found` failed with the system's error `code` (errno).
std::string open_error(const FoundLine& found, const LineAddress& address, int code);

/// Why the device node `path` could not be opened, with the group that may.
std::string chip_error(const std::string& path, int code);

}  // namespace orbwatch::hal
