// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <span>

#include "hal/mcap/limits.h"
#include "hal/mcap/record.h"
#include "hal/mcap/zstd_codec.h"

namespace orbwatch::hal::mcap {

/// A message; `data` lies in the loaded chunk.
struct Message {
  MessageHead head;
  std::span<const std::byte> data;
};

/// Fields in front of a chunk's records, which `stored` receives. Error: another size than that of
/// the record.
FileResult<ChunkHead> parse_chunk(const RecordView& view, std::span<const std::byte>& stored);

/// Error of a chunk at `offset` that is beyond the limits or neither zstd nor uncompressed.
FileResult<> check_limits(const ChunkHead& head, std::uint64_t offset, const Limits& limits);

/// Decompresses chunks of any origin, one at a time, into a buffer that is kept. Thread-bound.
class ChunkLoader {
 public:
  /// Records of the chunk, checked by its CRC and valid until the next call. Errors: beyond the
  /// limits, damaged.
  FileResult<std::span<const std::byte>> load(const RecordView& view, const Limits& limits);

 private:
  FileResult<> unpack(const ChunkHead& head, std::span<const std::byte> stored);

  ZstdDecoder zstd_;
  Bytes records_;
};

/// Message of a record in a chunk. Error: shorter than its fields.
FileResult<Message> parse_message(const RecordView& view);

/// The same error, of a place within the chunk at `offset`.
tl::unexpected<FileError> within_chunk(FileError error, std::uint64_t offset);

}  // namespace orbwatch::hal::mcap
