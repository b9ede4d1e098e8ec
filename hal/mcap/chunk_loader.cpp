// SPDX-License-Identifier: Apache-2.0
#include "hal/mcap/chunk_loader.h"

#include <utility>

#include "hal/mcap/crc32.h"

namespace orbwatch::hal::mcap {

FileResult<ChunkHead> parse_chunk(const RecordView& view, std::span<const std::byte>& stored) {
  auto head = parse<ChunkHead>(view, &stored);
  if (!head || head->stored_size == stored.size()) return head;
  return refuse(place_of(view.opcode, view.offset) + ": records of " +
                std::to_string(head->stored_size) + " bytes, but the chunk has " +
                std::to_string(stored.size()));
}

FileResult<> check_limits(const ChunkHead& head, std::uint64_t offset, const Limits& limits) {
  const std::string place = place_of(Opcode::Chunk, offset);
  if (head.uncompressed_size > limits.chunk) {
    return refuse(place + ": " + std::to_string(head.uncompressed_size) +
                  " bytes uncompressed; at most " + std::to_string(limits.chunk));
  }
  if (head.compression.empty() || head.compression == kZstd) return {};
  return refuse(place + ": an unknown compression; it must be zstd or none");
}

FileResult<std::span<const std::byte>> ChunkLoader::load(const RecordView& view,
                                                         const Limits& limits) {
  std::span<const std::byte> stored;
  auto head = parse_chunk(view, stored);
  if (!head) return error_of(head);
  if (auto checked = check_limits(*head, view.offset, limits); !checked) return error_of(checked);
  const std::string place = place_of(view.opcode, view.offset);
  if (auto done = unpack(*head, stored); !done) return refuse(place + ": " + done.error().message);
  const auto records = head->compression.empty() ? stored : std::span<const std::byte>(records_);
  const std::uint32_t crc = head->uncompressed_crc == 0 ? 0 : crc32_of(records);
  if (crc == head->uncompressed_crc) return records;
  return refuse(place + ": the CRC of its records is " + std::to_string(crc) +
                ", the chunk states " + std::to_string(head->uncompressed_crc));
}

FileResult<> ChunkLoader::unpack(const ChunkHead& head, std::span<const std::byte> stored) {
  if (head.compression.empty()) {
    if (head.uncompressed_size == stored.size()) return {};
    return refuse(std::to_string(stored.size()) + " bytes, but the chunk states " +
                  std::to_string(head.uncompressed_size));
  }
  // A false size is refused before memory is allocated for it.
  if (auto checked = ZstdDecoder::check_size(stored, head.uncompressed_size); !checked) {
    return checked;
  }
  return zstd_.decode(stored, resized(records_, static_cast<std::size_t>(head.uncompressed_size)));
}

FileResult<Message> parse_message(const RecordView& view) {
  Message message;
  auto head = parse<MessageHead>(view, &message.data);
  if (!head) return error_of(head);
  message.head = *head;
  return message;
}

tl::unexpected<FileError> within_chunk(FileError error, std::uint64_t offset) {
  return refuse(std::move(error.message) + " of the chunk at byte " + std::to_string(offset));
}

}  // namespace orbwatch::hal::mcap
