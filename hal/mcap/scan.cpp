// SPDX-License-Identifier: Apache-2.0
#include "hal/mcap/scan.h"

#include <algorithm>
#include <utility>

#include "hal/mcap/attachment.h"
#include "hal/mcap/chunk_loader.h"
#include "hal/mcap/crc32.h"
#include "hal/mcap/names.h"
#include "hal/mcap/record_file.h"

namespace orbwatch::hal::mcap {
namespace {

/// True if the data section ends in front of such a record.
bool ends_data(Opcode opcode) {
  switch (opcode) {
    case Opcode::Header:
    case Opcode::Footer:
    case Opcode::ChunkIndex:
    case Opcode::AttachmentIndex:
    case Opcode::Statistics:
    case Opcode::MetadataIndex:
    case Opcode::SummaryOffset:
    case Opcode::DataEnd:
      return true;
    default:
      return static_cast<int>(opcode) == 0;  // space that a power cut left without data
  }
}

/// Walks over the records of the data section.
class Scanner {
 public:
  Scanner(const File& file, const Limits& limits) : file_(file), limits_(limits) {}

  FileResult<> begin();
  /// False: there is no further record.
  FileResult<bool> step();
  Scan finish();

 private:
  /// Condition of a record; errors refuse the file.
  enum class Condition { Good, Damaged, Unknown };

  FileResult<Condition> add(const RecordView& view);
  FileResult<Condition> add_chunk(const RecordView& view);
  FileResult<Condition> add_index(const RecordView& view);
  FileResult<Condition> add_attachment(const RecordView& view);
  FileResult<Condition> add_metadata(const RecordView& view);
  FileResult<> add_chunk_record(const RecordView& view);
  template <class Record>
  FileResult<> define(const RecordView& view);
  /// Counts bytes of the summary. Error: beyond the limit.
  FileResult<> grow(std::size_t bytes, std::uint64_t offset);

  const File& file_;
  const Limits& limits_;
  Scan scan_;
  Bytes content_;
  ChunkLoader loader_;
  std::uint64_t size_ = 0;
  std::uint64_t offset_ = 0;
  std::uint32_t crc_ = 0;      ///< of all bytes in front of offset_
  std::uint64_t damaged_ = 0;  ///< since the last good record
  std::size_t summary_bytes_ = 0;
  std::uint32_t chunk_crc_ = 0;   ///< of all bytes up to the end of the last chunk
  bool is_behind_chunk_ = false;  ///< only its indexes may follow
};

FileResult<> Scanner::begin() {
  const auto size = file_.size();
  if (!size) return tl::unexpected(size.error());
  auto begin = read_begin(file_, limits_);
  if (!begin) return error_of(begin);
  if (!*begin) return {};
  Bytes bytes(static_cast<std::size_t>((*begin)->data_begin));
  if (auto done = file_.read(0, bytes); !done) return done;
  size_ = *size;
  scan_.header = std::move((*begin)->header);
  scan_.data_end = offset_ = bytes.size();
  scan_.data_crc = crc_ = crc32_of(bytes);
  return {};
}

FileResult<bool> Scanner::step() {
  auto head = read_head(file_, offset_, size_);
  if (!head) return error_of(head);
  if (!*head || ends_data((*head)->opcode)) return false;
  auto view = load_record(file_, offset_, **head, limits_, content_);
  if (!view) return error_of(view);
  Bytes bytes;
  FieldWriter fields(bytes);
  fields(static_cast<std::uint8_t>(view->opcode), (*head)->length);
  crc_ = crc32_of(view->content, crc32_of(bytes, crc_));
  offset_ += kRecordHead + (*head)->length;
  if (view->opcode != Opcode::MessageIndex) is_behind_chunk_ = false;
  const auto condition = add(*view);
  if (!condition) return file_.named(condition.error());
  if (*condition == Condition::Damaged) ++damaged_;
  if (*condition == Condition::Good) {
    scan_.data_end = offset_;
    scan_.data_crc = crc_;
    scan_.damaged += std::exchange(damaged_, 0);
  }
  return true;
}

FileResult<Scanner::Condition> Scanner::add(const RecordView& view) {
  FileResult<> defined;
  switch (view.opcode) {
    case Opcode::Schema:
      defined = define<Schema>(view);
      break;
    case Opcode::Channel:
      defined = define<Channel>(view);
      break;
    case Opcode::Chunk:
      return add_chunk(view);
    case Opcode::MessageIndex:
      return add_index(view);
    case Opcode::Attachment:
      return add_attachment(view);
    case Opcode::Metadata:
      return add_metadata(view);
    case Opcode::Message:
      return refuse(place_of(view.opcode, view.offset) + ": messages must be in chunks");
    default:
      return Condition::Unknown;  // of a later version of MCAP, or private
  }
  if (!defined) return error_of(defined);
  return Condition::Good;
}

template <class Record>
FileResult<> Scanner::define(const RecordView& view) {
  auto record = parse<Record>(view);
  if (!record) return error_of(record);
  const auto count = [this] {
    return scan_.summary.schemas.size() + scan_.summary.channels.size();
  };
  const std::size_t before = count();
  auto added = scan_.summary.add(std::move(*record), view.offset);
  if (!added || count() == before) return added;
  return grow(kRecordHead + view.content.size(), view.offset);
}

FileResult<> Scanner::grow(std::size_t bytes, std::uint64_t offset) {
  summary_bytes_ += bytes;
  if (summary_bytes_ <= limits_.summary) return {};
  return refuse("byte " + std::to_string(offset) + ": the summary exceeds " +
                std::to_string(limits_.summary) + " bytes");
}

FileResult<Scanner::Condition> Scanner::add_chunk(const RecordView& view) {
  std::span<const std::byte> stored;
  auto head = parse_chunk(view, stored);
  if (!head) return Condition::Damaged;
  if (auto checked = check_limits(*head, view.offset, limits_); !checked) return error_of(checked);
  const auto records = loader_.load(view, limits_);
  if (!records) return Condition::Damaged;
  scan_.last_indexes.clear();
  auto done = for_each_record(
      *records, 0, [this](const RecordView& record) { return add_chunk_record(record); });
  if (!done) return within_chunk(done.error(), view.offset);
  ChunkIndex index{scan_.last_indexes.start_time(),
                   scan_.last_indexes.end_time(),
                   view.offset,
                   kRecordHead + view.content.size(),
                   {},
                   0,
                   head->compression,
                   head->stored_size,
                   head->uncompressed_size};
  Bytes bytes;
  append_record(bytes, index);
  const std::size_t offsets = 10 * scan_.last_indexes.channels();
  if (auto grown = grow(bytes.size() + offsets, view.offset); !grown) return error_of(grown);
  scan_.last_indexes.for_each([this](const MessageIndex& messages) {
    scan_.summary.message_counts[messages.channel_id] += messages.messages.size();
  });
  scan_.summary.chunks.push_back(std::move(index));
  chunk_crc_ = crc_;
  is_behind_chunk_ = true;
  return Condition::Good;
}

FileResult<> Scanner::add_chunk_record(const RecordView& view) {
  switch (view.opcode) {
    case Opcode::Schema:
      return define<Schema>(view);
    case Opcode::Channel:
      return define<Channel>(view);
    case Opcode::Message:
      break;
    default:
      return {};  // of a later version of MCAP, or private
  }
  auto message = parse_message(view);
  if (!message) return error_of(message);
  if (!scan_.summary.channels.contains(message->head.channel_id)) {
    return refuse(place_of(view.opcode, view.offset) + ": channel " +
                  std::to_string(message->head.channel_id) + " is unknown");
  }
  scan_.last_indexes.add(message->head, view.offset);
  return {};
}

FileResult<Scanner::Condition> Scanner::add_index(const RecordView& view) {
  if (!is_behind_chunk_ || !scan_.last_indexes.equals(view.content)) return Condition::Unknown;
  std::uint16_t channel = 0;
  FieldReader fields(view.content);
  fields(channel);
  ChunkIndex& chunk = scan_.summary.chunks.back();
  const bool is_known = std::ranges::any_of(chunk.message_index_offsets,
                                            [&](const auto& at) { return at.first == channel; });
  if (is_known) return Condition::Unknown;
  chunk.message_index_offsets.emplace_back(channel, view.offset);
  chunk.message_index_length =
      view.offset + kRecordHead + view.content.size() - chunk.offset - chunk.length;
  return Condition::Good;
}

FileResult<Scanner::Condition> Scanner::add_attachment(const RecordView& view) {
  std::span<const std::byte> data;
  const auto head = parse_attachment(view, data);
  if (!head) return Condition::Damaged;
  auto named = check_attachment_name(place_of(view.opcode, view.offset), head->name);
  if (!named) return error_of(named);
  AttachmentIndex index{view.offset,     kRecordHead + view.content.size(),
                        head->log_time,  head->create_time,
                        head->data_size, head->name,
                        head->media_type};
  Bytes bytes;
  append_record(bytes, index);
  if (auto grown = grow(bytes.size(), view.offset); !grown) return error_of(grown);
  scan_.summary.attachments.push_back(std::move(index));
  return Condition::Good;
}

FileResult<Scanner::Condition> Scanner::add_metadata(const RecordView& view) {
  auto metadata = parse<Metadata>(view);
  if (!metadata) return Condition::Damaged;
  auto named = check_name(place_of(view.opcode, view.offset), metadata->name);
  if (!named) return error_of(named);
  MetadataIndex index{view.offset, kRecordHead + view.content.size(), metadata->name};
  Bytes bytes;
  append_record(bytes, index);
  if (auto grown = grow(bytes.size(), view.offset); !grown) return error_of(grown);
  scan_.summary.metadata.push_back(std::move(index));
  return Condition::Good;
}

Scan Scanner::finish() {
  if (scan_.summary.chunks.empty()) return std::move(scan_);
  ChunkIndex& chunk = scan_.summary.chunks.back();
  const std::uint64_t end = chunk.offset + chunk.length;
  const bool is_last = scan_.data_end == end + chunk.message_index_length;
  if (is_last && chunk.message_index_offsets.size() < scan_.last_indexes.channels()) {
    scan_.lacks_indexes = true;
    scan_.data_end = end;
    scan_.data_crc = chunk_crc_;
  }
  return std::move(scan_);
}

}  // namespace

FileResult<Scan> scan(const File& file, const Limits& limits) {
  Scanner scanner(file, limits);
  if (auto begun = scanner.begin(); !begun) return error_of(begun);
  for (;;) {
    auto more = scanner.step();
    if (!more) return error_of(more);
    if (!*more) return scanner.finish();
  }
}

}  // namespace orbwatch::hal::mcap
