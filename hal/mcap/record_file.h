// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <optional>

#include "hal/mcap/file.h"
#include "hal/mcap/limits.h"
#include "hal/mcap/record.h"

/// Reading of single records of a file of any origin.
namespace orbwatch::hal::mcap {

/// Opcode and length in front of a record's content.
struct RecordHead {
  Opcode opcode{};
  std::uint64_t length = 0;  ///< bytes of the content
};

/// Head of the record at `offset`; nullopt: the file of `size` bytes ends within the record.
FileResult<std::optional<RecordHead>> read_head(const File& file, std::uint64_t offset,
                                                std::uint64_t size);

/// Loads the content of a record into a buffer that is kept. Error: beyond the limits.
FileResult<RecordView> load_record(const File& file, std::uint64_t offset, const RecordHead& head,
                                   const Limits& limits, Bytes& buffer);

/// Loads the record that an index lists, with the length that it states for the whole record.
/// Error: another record is there.
FileResult<RecordView> load_listed(const File& file, Opcode opcode, std::uint64_t offset,
                                   std::uint64_t length, const Limits& limits, Bytes& buffer);

/// Header behind the magic, and the offset of the first record behind it.
struct FileBegin {
  Header header;
  std::uint64_t data_begin = 0;
};

/// Begin of the file; nullopt: the file ends within it. Error: not an MCAP file.
FileResult<std::optional<FileBegin>> read_begin(const File& file, const Limits& limits);

}  // namespace orbwatch::hal::mcap
