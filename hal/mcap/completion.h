// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <filesystem>

#include "hal/mcap/file_result.h"
#include "hal/mcap/limits.h"

namespace orbwatch::hal::mcap {

/// Outcome of complete().
struct Completion {
  bool was_finished = false;        ///< nothing was to be done
  std::uint64_t messages = 0;       ///< number in the file now
  std::uint64_t dropped_bytes = 0;  ///< bytes of the torn record
  std::uint64_t damaged = 0;        ///< records with a wrong CRC, kept but not listed
};

/// Finishes a recording whose writer ended early: drops the torn record at its end and writes the
/// summary that a finished one has. Reads the whole file. A power cut while it runs is harmless:
/// the next call completes the file as well, because a summary with a wrong CRC counts as none. A
/// finished file is not changed. Errors: being written by another process; not a recording (see
/// Reader); errors of the disk, after which the file holds the same messages. Reentrant.
FileResult<Completion> complete(const std::filesystem::path& path, const Limits& limits = {});

}  // namespace orbwatch::hal::mcap
