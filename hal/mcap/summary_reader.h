// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <optional>

#include "hal/mcap/file.h"
#include "hal/mcap/limits.h"
#include "hal/mcap/summary.h"

namespace orbwatch::hal::mcap {

/// Section of an open file that holds its summary.
struct SummarySection {
  std::uint64_t begin = 0;
  std::uint64_t offsets = 0;  ///< begin of the summary offsets; the footer if there are none
  std::uint64_t footer = 0;
  std::uint32_t crc = 0;  ///< 0: none

  /// End of the data section, whose last record is DataEnd.
  std::uint64_t data_end() const { return begin - kDataEndSize; }
};

/// Place of the summary by the footer at the file's end; nullopt: the file has no footer or no
/// summary. Error: an impossible place, or more than limits.summary bytes.
FileResult<std::optional<SummarySection>> find_summary(const File& file, const Limits& limits);

/// Reads the summary. Errors: damaged; records outside of the data section or over each other;
/// beyond the limits.
FileResult<Summary> read_summary(const File& file, const SummarySection& section,
                                 const Limits& limits);

}  // namespace orbwatch::hal::mcap
