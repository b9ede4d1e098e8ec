// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <limits>
#include <optional>
#include <string_view>

#include "proc/image/result.h"

namespace orbwatch::app::recorder {

/// An end of a range of frame sets, which belongs to it.
struct RangeEnd {
  bool is_moment = false;
  std::uint64_t value = 0;  ///< number of the frame set, or nanoseconds of UTC since 1970
};

/// Frame sets to export; an end that is not set is that of the recording.
struct ExportRange {
  std::optional<RangeEnd> from, to;
};

/// Parses the number of a frame set, or a moment of UTC such as 2026-11-28T09:22:00.125Z. Error:
/// neither. Reentrant.
Result<RangeEnd> parse_range_end(std::string_view text);

/// Stamps of the frame sets in a range: those of all messages that belong to them.
struct StampRange {
  std::uint64_t first = 0, last = std::numeric_limits<std::uint64_t>::max();
  std::size_t sets = 0;  ///< frame sets in it

  bool has(std::uint64_t stamp) const { return stamp >= first && stamp <= last; }
};

/// Finds the range in a recording by its states. Errors: those of RecordedStates; no frame set in
/// the range.
Result<StampRange> stamps_in(const std::filesystem::path& recording, const ExportRange& range);

}  // namespace orbwatch::app::recorder
