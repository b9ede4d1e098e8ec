// SPDX-License-Identifier: Apache-2.0
#include "hal/mcap/message_indexes.h"

namespace orbwatch::hal::mcap {

std::size_t MessageIndexes::channels() const {
  std::size_t count = 0;
  for_each([&](const MessageIndex&) { ++count; });
  return count;
}

bool MessageIndexes::equals(std::span<const std::byte> content) const {
  std::uint16_t channel = 0;
  std::uint32_t size = 0;
  FieldReader fields(content);
  if (!fields(channel, size) || size != fields.rest().size()) return false;
  const auto index = indexes_.find(channel);
  if (index == indexes_.end() || index->second.messages.empty()) return false;
  for (const auto& [log_time, offset] : index->second.messages) {
    std::uint64_t stated_time = 0, stated_offset = 0;
    if (!fields(stated_time, stated_offset)) return false;
    if (stated_time != log_time || stated_offset != offset) return false;
  }
  return fields.rest().empty();
}

void MessageIndexes::append_to(Bytes& out, std::uint64_t offset, ChunkIndex& chunk) const {
  const std::size_t begin = out.size();
  chunk.message_index_offsets.clear();
  for_each([&](const MessageIndex& index) {
    chunk.message_index_offsets.emplace_back(index.channel_id, offset + out.size() - begin);
    append_record(out, index);
  });
  chunk.message_index_length = out.size() - begin;
}

}  // namespace orbwatch::hal::mcap
