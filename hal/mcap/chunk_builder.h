// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include "hal/mcap/message_indexes.h"
#include "hal/mcap/record.h"

namespace orbwatch::hal::mcap {

/// Bytes of a message's record without its data.
inline constexpr std::size_t kMessageSize = kRecordHead + 2 + 4 + 8 + 8;

/// Records of the chunk that is written next, in a buffer that is reused. Thread-bound.
class ChunkBuilder {
 public:
  /// Buffer for `most` bytes of records.
  explicit ChunkBuilder(std::size_t most) : most_(most) { records_.reserve(most); }

  bool is_empty() const { return records_.empty(); }
  /// Bytes that are free.
  std::size_t room() const { return most_ - records_.size(); }

  /// Appends a message; the room must suffice.
  void append(const MessageHead& head, std::span<const std::byte> data) {
    indexes_.add(head, records_.size());
    append_record(records_, head, data.size());
    records_.insert(records_.end(), data.begin(), data.end());
  }
  /// Appends encoded schemas and channels; the room must suffice.
  void append(std::span<const std::byte> definitions) {
    records_.insert(records_.end(), definitions.begin(), definitions.end());
  }
  void clear() {
    records_.clear();
    indexes_.clear();
  }

  std::span<const std::byte> records() const { return records_; }
  const MessageIndexes& indexes() const { return indexes_; }

 private:
  std::size_t most_;
  Bytes records_;
  MessageIndexes indexes_;
};

}  // namespace orbwatch::hal::mcap
