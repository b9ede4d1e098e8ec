// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <span>
#include <string>

#include "hal/mcap/record.h"

namespace orbwatch::hal::mcap {

/// A file within a recording, such as the site, the rig or a recipe.
struct Attachment {
  std::uint64_t log_time = 0;
  std::uint64_t create_time = 0;  ///< 0: unknown
  std::string name;               ///< relative path without ".."
  std::string media_type;
  Bytes data;
};

/// Appends the record with its CRC.
void append_attachment(Bytes& out, const Attachment& attachment);

/// Fields of an attachment, and its data, checked by its CRC. Error: damaged.
FileResult<AttachmentHead> parse_attachment(const RecordView& view,
                                            std::span<const std::byte>& data);

}  // namespace orbwatch::hal::mcap
