// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <optional>

#include "hal/mcap/file.h"
#include "hal/mcap/limits.h"
#include "hal/mcap/message_indexes.h"
#include "hal/mcap/summary.h"

namespace orbwatch::hal::mcap {

/// Complete records of a file that has no summary, since it is being written or the power was cut.
struct Scan {
  std::optional<Header> header;  ///< nullopt: the file ends within its header
  Summary summary;
  std::uint64_t data_end = 0;   ///< end of the last complete record; what follows is torn
  std::uint32_t data_crc = 0;   ///< CRC of all bytes in front of data_end
  std::uint64_t damaged = 0;    ///< chunks and attachments in front of data_end with a wrong CRC
  MessageIndexes last_indexes;  ///< indexes of the last chunk
  bool lacks_indexes = false;   ///< true: they are torn, and data_end is that chunk's end
};

/// Reads the whole data section and checks all CRCs. Errors: not an MCAP file, beyond the limits, a
/// record that contradicts others or is not supported.
FileResult<Scan> scan(const File& file, const Limits& limits);

}  // namespace orbwatch::hal::mcap
