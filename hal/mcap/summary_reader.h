// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <optional>

#include "hal/mcap/file.h"
#include "hal/mcap/limits.h"
#include "hal/mcap/summary.h"

namespace orbwatch::hal::mcap {

/// Section of a file that holds its summary, with the right CRC or none.
struct SummarySection {
  std::uint64_t begin = 0;
  std::uint64_t offsets = 0;  ///< begin of the summary offsets; the footer if there are none
  Bytes bytes;                ///< from `begin` up to the footer's CRC

  /// End of the data section, whose last record is DataEnd.
  std::uint64_t data_end() const { return begin - kDataEndSize; }
};

/// Loads the summary by the footer at the file's end; nullopt: the file has no footer, no summary,
/// or one whose CRC is wrong because a power cut left a part of it. Error: an impossible place, or
/// more than limits.summary bytes.
FileResult<std::optional<SummarySection>> find_summary(const File& file, const Limits& limits);

/// Reads the summary. `file` names errors. Errors: records outside of the data section or over each
/// other; beyond the limits.
FileResult<Summary> read_summary(const File& file, const SummarySection& section,
                                 const Limits& limits);

}  // namespace orbwatch::hal::mcap
