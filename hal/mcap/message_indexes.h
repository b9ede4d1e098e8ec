// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <cstdint>
#include <limits>
#include <map>
#include <span>

#include "hal/mcap/record.h"

namespace orbwatch::hal::mcap {

/// Index of the messages of one chunk, by channel; kept and reused from chunk to chunk.
class MessageIndexes {
 public:
  void clear() {
    for (auto& [channel, index] : indexes_) index.messages.clear();
    start_ = kNone;
    end_ = 0;
  }

  /// `offset`: of the message's record in the uncompressed records of the chunk.
  void add(const MessageHead& message, std::uint64_t offset) {
    MessageIndex& index = indexes_[message.channel_id];
    index.channel_id = message.channel_id;
    index.messages.emplace_back(message.log_time, offset);
    start_ = std::min(start_, message.log_time);
    end_ = std::max(end_, message.log_time);
  }

  /// Earliest and latest log_time; 0 without messages.
  std::uint64_t start_time() const { return start_ == kNone ? 0 : start_; }
  std::uint64_t end_time() const { return end_; }

  /// Calls `act` with the index of each channel that has messages, in the order of their ids.
  template <class Act>
  void for_each(Act act) const {
    for (const auto& [channel, index] : indexes_) {
      if (!index.messages.empty()) act(index);
    }
  }

  /// Number of channels with messages.
  std::size_t channels() const;

  /// True when `content` of a message index states the same messages in the same order.
  bool equals(std::span<const std::byte> content) const;

  /// Appends the records, of which the first is at `offset` of the file, and enters them in `chunk`
  /// instead of those that it had.
  void append_to(Bytes& out, std::uint64_t offset, ChunkIndex& chunk) const;

 private:
  static constexpr std::uint64_t kNone = std::numeric_limits<std::uint64_t>::max();

  std::map<std::uint16_t, MessageIndex> indexes_;
  std::uint64_t start_ = kNone;
  std::uint64_t end_ = 0;
};

}  // namespace orbwatch::hal::mcap
