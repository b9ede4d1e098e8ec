// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <map>
#include <vector>

#include "hal/mcap/record.h"

namespace orbwatch::hal::mcap {

/// Contents of a file with their places: its summary section, or the same found by a scan of its
/// data.
struct Summary {
  std::map<std::uint16_t, Schema> schemas;
  std::map<std::uint16_t, Channel> channels;
  std::map<std::uint16_t, std::uint64_t> message_counts;  ///< number by channel, if stated
  std::vector<ChunkIndex> chunks;                         ///< sorted by offset
  std::vector<AttachmentIndex> attachments;               ///< sorted by offset
  std::vector<MetadataIndex> metadata;                    ///< sorted by offset

  /// Adds it, or does nothing when it is there. `offset` stands in errors. Errors: another one has
  /// the id; a wrong name; a channel of an unknown schema.
  FileResult<> add(Schema schema, std::uint64_t offset);
  FileResult<> add(Channel channel, std::uint64_t offset);

  /// Derived from the rest.
  Statistics statistics() const;
};

/// Appends the end of a file: DataEnd at `data_end`, summary, summary offsets, footer and magic.
/// `data_crc`: of all bytes in front of data_end.
void append_end(Bytes& out, const Summary& summary, std::uint64_t data_end, std::uint32_t data_crc);

}  // namespace orbwatch::hal::mcap
