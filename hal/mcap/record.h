// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "hal/mcap/fields.h"
#include "hal/mcap/file_result.h"

/// Records of MCAP (https://mcap.dev/spec), each declared once for writing and reading. Times are
/// nanoseconds of UTC since 1970, offsets count from the start of the file.
namespace orbwatch::hal::mcap {

/// First and last bytes of a file.
inline constexpr std::array kMagic{std::byte{0x89}, std::byte{'M'}, std::byte{'C'},
                                   std::byte{'A'},  std::byte{'P'}, std::byte{'0'},
                                   std::byte{'\r'}, std::byte{'\n'}};

enum class Opcode : std::uint8_t {
  Header = 1,
  Footer,
  Schema,
  Channel,
  Message,
  Chunk,
  MessageIndex,
  ChunkIndex,
  Attachment,
  AttachmentIndex,
  Statistics,
  Metadata,
  MetadataIndex,
  SummaryOffset,
  DataEnd
};

/// Name for messages: "chunk index", or "record 77" for a code that MCAP does not define.
std::string name_of(Opcode opcode);

/// Opcode and length in front of the content of each record.
inline constexpr std::size_t kRecordHead = 1 + 8;

using StringMap = std::vector<std::pair<std::string, std::string>>;

struct Header {
  static constexpr Opcode kOpcode = Opcode::Header;
  std::string profile = "ros2";
  std::string writer = "orbwatch";  ///< name of the program

  template <class Self, class Fields>
  static auto visit(Self& self, Fields& fields) {
    return fields(self.profile, self.writer);
  }
};

struct Footer {
  static constexpr Opcode kOpcode = Opcode::Footer;
  std::uint64_t summary_start = 0;         ///< 0: no summary
  std::uint64_t summary_offset_start = 0;  ///< 0: no summary offsets
  std::uint32_t summary_crc = 0;           ///< from summary_start to the field before; 0: none

  template <class Self, class Fields>
  static auto visit(Self& self, Fields& fields) {
    return fields(self.summary_start, self.summary_offset_start, self.summary_crc);
  }
};

struct Schema {
  static constexpr Opcode kOpcode = Opcode::Schema;
  std::uint16_t id = 0;              ///< from 1
  std::string name;                  ///< sensor_msgs/msg/Image
  std::string encoding = "ros2msg";  ///< format of `data`
  std::string data;                  ///< definition of the message and all its parts

  bool operator==(const Schema&) const = default;
  template <class Self, class Fields>
  static auto visit(Self& self, Fields& fields) {
    return fields(self.id, self.name, self.encoding, self.data);
  }
};

struct Channel {
  static constexpr Opcode kOpcode = Opcode::Channel;
  std::uint16_t id = 0;
  std::uint16_t schema_id = 0;  ///< 0: messages have no schema
  std::string topic;
  std::string message_encoding = "cdr";
  StringMap metadata;

  bool operator==(const Channel&) const = default;
  template <class Self, class Fields>
  static auto visit(Self& self, Fields& fields) {
    return fields(self.id, self.schema_id, self.topic, self.message_encoding, self.metadata);
  }
};

/// Fields in front of a message's data.
struct MessageHead {
  static constexpr Opcode kOpcode = Opcode::Message;
  std::uint16_t channel_id = 0;
  std::uint32_t sequence = 0;
  std::uint64_t log_time = 0;      ///< time of the recording
  std::uint64_t publish_time = 0;  ///< time of the message; if unknown, log_time

  bool operator==(const MessageHead&) const = default;
  template <class Self, class Fields>
  static auto visit(Self& self, Fields& fields) {
    return fields(self.channel_id, self.sequence, self.log_time, self.publish_time);
  }
};

/// Fields in front of a chunk's records.
struct ChunkHead {
  static constexpr Opcode kOpcode = Opcode::Chunk;
  std::uint64_t message_start_time = 0;  ///< earliest log_time
  std::uint64_t message_end_time = 0;    ///< latest log_time
  std::uint64_t uncompressed_size = 0;
  std::uint32_t uncompressed_crc = 0;  ///< 0: none
  std::string compression;             ///< zstd, or empty
  std::uint64_t stored_size = 0;       ///< bytes of the records as they follow

  template <class Self, class Fields>
  static auto visit(Self& self, Fields& fields) {
    return fields(self.message_start_time, self.message_end_time, self.uncompressed_size,
                  self.uncompressed_crc, self.compression, self.stored_size);
  }
};

/// Messages of one channel in the chunk in front.
struct MessageIndex {
  static constexpr Opcode kOpcode = Opcode::MessageIndex;
  std::uint16_t channel_id = 0;
  /// log_time and offset in the uncompressed records
  std::vector<std::pair<std::uint64_t, std::uint64_t>> messages;

  bool operator==(const MessageIndex&) const = default;
  template <class Self, class Fields>
  static auto visit(Self& self, Fields& fields) {
    return fields(self.channel_id, self.messages);
  }
};

struct ChunkIndex {
  static constexpr Opcode kOpcode = Opcode::ChunkIndex;
  std::uint64_t message_start_time = 0;
  std::uint64_t message_end_time = 0;
  std::uint64_t offset = 0;
  std::uint64_t length = 0;  ///< bytes of the record with its head
  std::vector<std::pair<std::uint16_t, std::uint64_t>>
      message_index_offsets;  ///< offset by channel
  std::uint64_t message_index_length = 0;
  std::string compression;
  std::uint64_t stored_size = 0;
  std::uint64_t uncompressed_size = 0;

  template <class Self, class Fields>
  static auto visit(Self& self, Fields& fields) {
    return fields(self.message_start_time, self.message_end_time, self.offset, self.length,
                  self.message_index_offsets, self.message_index_length, self.compression,
                  self.stored_size, self.uncompressed_size);
  }
};

/// Fields in front of an attachment's data; the data's CRC follows it.
struct AttachmentHead {
  static constexpr Opcode kOpcode = Opcode::Attachment;
  std::uint64_t log_time = 0;
  std::uint64_t create_time = 0;  ///< 0: unknown
  std::string name;               ///< relative path such as recipes/weld.toml
  std::string media_type;         ///< application/toml
  std::uint64_t data_size = 0;

  template <class Self, class Fields>
  static auto visit(Self& self, Fields& fields) {
    return fields(self.log_time, self.create_time, self.name, self.media_type, self.data_size);
  }
};

struct AttachmentIndex {
  static constexpr Opcode kOpcode = Opcode::AttachmentIndex;
  std::uint64_t offset = 0;
  std::uint64_t length = 0;  ///< bytes of the record with its head
  std::uint64_t log_time = 0;
  std::uint64_t create_time = 0;
  std::uint64_t data_size = 0;
  std::string name;
  std::string media_type;

  template <class Self, class Fields>
  static auto visit(Self& self, Fields& fields) {
    return fields(self.offset, self.length, self.log_time, self.create_time, self.data_size,
                  self.name, self.media_type);
  }
};

struct Statistics {
  static constexpr Opcode kOpcode = Opcode::Statistics;
  std::uint64_t message_count = 0;
  std::uint16_t schema_count = 0;
  std::uint32_t channel_count = 0;
  std::uint32_t attachment_count = 0;
  std::uint32_t metadata_count = 0;
  std::uint32_t chunk_count = 0;
  std::uint64_t message_start_time = 0;
  std::uint64_t message_end_time = 0;
  std::vector<std::pair<std::uint16_t, std::uint64_t>> message_counts;  ///< number by channel

  template <class Self, class Fields>
  static auto visit(Self& self, Fields& fields) {
    return fields(self.message_count, self.schema_count, self.channel_count, self.attachment_count,
                  self.metadata_count, self.chunk_count, self.message_start_time,
                  self.message_end_time, self.message_counts);
  }
};

struct Metadata {
  static constexpr Opcode kOpcode = Opcode::Metadata;
  std::string name;
  StringMap entries;

  bool operator==(const Metadata&) const = default;
  template <class Self, class Fields>
  static auto visit(Self& self, Fields& fields) {
    return fields(self.name, self.entries);
  }
};

struct MetadataIndex {
  static constexpr Opcode kOpcode = Opcode::MetadataIndex;
  std::uint64_t offset = 0;
  std::uint64_t length = 0;  ///< bytes of the record with its head
  std::string name;

  template <class Self, class Fields>
  static auto visit(Self& self, Fields& fields) {
    return fields(self.offset, self.length, self.name);
  }
};

/// Place of the records of one opcode in the summary.
struct SummaryOffset {
  static constexpr Opcode kOpcode = Opcode::SummaryOffset;
  std::uint8_t group_opcode = 0;
  std::uint64_t group_start = 0;
  std::uint64_t group_length = 0;

  template <class Self, class Fields>
  static auto visit(Self& self, Fields& fields) {
    return fields(self.group_opcode, self.group_start, self.group_length);
  }
};

struct DataEnd {
  static constexpr Opcode kOpcode = Opcode::DataEnd;
  std::uint32_t data_crc = 0;  ///< CRC of all bytes in front of this record; 0: none

  template <class Self, class Fields>
  static auto visit(Self& self, Fields& fields) {
    return fields(self.data_crc);
  }
};

/// Bytes of DataEnd and of Footer with their heads; both have a fixed size.
inline constexpr std::size_t kDataEndSize = kRecordHead + 4;
inline constexpr std::size_t kFooterSize = kRecordHead + 8 + 8 + 4;

/// Appends a record whose content is `record`, and `data_size` bytes that the caller writes next.
template <class Record>
void append_record(Bytes& out, const Record& record, std::uint64_t data_size = 0) {
  FieldWriter fields(out);
  fields(static_cast<std::uint8_t>(Record::kOpcode), std::uint64_t{0});
  const std::size_t begin = out.size();
  Record::visit(record, fields);
  fields.set(begin - sizeof(std::uint64_t), out.size() - begin + data_size);
}

/// "chunk index at byte 1234".
std::string place_of(Opcode opcode, std::uint64_t offset);

/// A record as it lies in memory.
struct RecordView {
  Opcode opcode{};
  std::span<const std::byte> content;  ///< bytes without the head
  std::uint64_t offset = 0;            ///< that of the head
};

/// Fields of the record; `rest`, if given, receives what follows the known ones. Error: a field
/// that ends beyond the content.
template <class Record>
FileResult<Record> parse(const RecordView& view, std::span<const std::byte>* rest = nullptr) {
  Record record;
  FieldReader fields(view.content);
  if (!Record::visit(record, fields)) {
    return refuse(place_of(view.opcode, view.offset) + ": " + std::string(fields.fault()) + " of " +
                  std::to_string(view.content.size()) + " bytes");
  }
  if (rest != nullptr) *rest = fields.rest();
  return record;
}

/// Calls `on_record` with each record of `bytes`, whose first byte has the offset `offset`, until
/// it returns an error. Error: a record that ends beyond the bytes.
template <class OnRecord>
FileResult<> for_each_record(std::span<const std::byte> bytes, std::uint64_t offset,
                             OnRecord on_record) {
  while (!bytes.empty()) {
    std::uint8_t opcode = 0;
    std::uint64_t length = 0;
    FieldReader head(bytes);
    const bool has_head = head(opcode, length);
    if (!has_head || length > head.rest().size()) {
      return refuse(place_of(static_cast<Opcode>(opcode), offset) + ": " + std::to_string(length) +
                    " bytes long, but " + std::to_string(head.rest().size()) + " bytes are left");
    }
    const auto size = static_cast<std::size_t>(length);
    const RecordView view{static_cast<Opcode>(opcode), head.rest().first(size), offset};
    if (auto done = on_record(view); !done) return done;
    bytes = head.rest().subspan(size);
    offset += kRecordHead + length;
  }
  return {};
}

}  // namespace orbwatch::hal::mcap
