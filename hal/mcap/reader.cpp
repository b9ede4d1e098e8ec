// SPDX-License-Identifier: Apache-2.0
#include "hal/mcap/reader.h"

#include <utility>

#include "hal/mcap/record_file.h"
#include "hal/mcap/scan.h"
#include "hal/mcap/summary_reader.h"

namespace orbwatch::hal::mcap {

FileResult<Reader> Reader::open(const std::filesystem::path& path, const Limits& limits) {
  auto file = File::open(path, File::Access::Read);
  if (!file) return error_of(file);
  return open(std::move(*file), limits);
}

FileResult<Reader> Reader::open(File file, const Limits& limits) {
  Reader reader(std::move(file), limits);
  auto is_read = reader.read_by_footer();
  if (!is_read) return error_of(is_read);
  if (*is_read) return reader;
  auto scanned = scan(reader.file_, limits);
  if (!scanned) return error_of(scanned);
  reader.header_ = scanned->header.value_or(Header{"", ""});
  reader.summary_ = std::move(scanned->summary);
  return reader;
}

FileResult<Reader> Reader::open_finished(const std::filesystem::path& path, const Limits& limits) {
  auto file = File::open(path, File::Access::Read);
  if (!file) return error_of(file);
  Reader reader(std::move(*file), limits);
  auto is_read = reader.read_by_footer();
  if (!is_read) return error_of(is_read);
  if (!*is_read) return reader.file_.named({0, "its summary is missing or damaged"});
  return reader;
}

/// Reads header and summary of a finished file. False: it has no summary, or a damaged one.
FileResult<bool> Reader::read_by_footer() {
  auto section = find_summary(file_, limits_);
  if (!section) return error_of(section);
  if (!*section) return false;
  auto begin = read_begin(file_, limits_);
  if (!begin) return error_of(begin);
  if (!*begin) return file_.named({0, "byte 8: the header ends beyond the file"});
  auto summary = read_summary(file_, **section, limits_);
  if (!summary) return error_of(summary);
  header_ = std::move((*begin)->header);
  summary_ = std::move(*summary);
  is_finished_ = true;
  return true;
}

FileResult<> Reader::load_chunk(std::size_t number) {
  const ChunkIndex& chunk = summary_.chunks.at(number);
  rest_ = {};
  auto view = load_listed(file_, Opcode::Chunk, chunk.offset, chunk.length, limits_, stored_);
  if (!view) return error_of(view);
  auto records = loader_.load(*view, limits_);
  if (!records) return file_.named(records.error());
  rest_ = *records;
  auto checked = check_chunk();
  if (checked) return {};
  rest_ = {};
  return file_.named(within_chunk(checked.error(), chunk.offset).value());
}

FileResult<> Reader::check_chunk() const {
  return for_each_record(rest_, 0, [this](const RecordView& view) -> FileResult<> {
    if (view.opcode != Opcode::Message) return {};
    auto message = parse_message(view);
    if (!message) return error_of(message);
    if (summary_.channels.contains(message->head.channel_id)) return {};
    return refuse(place_of(view.opcode, view.offset) + ": channel " +
                  std::to_string(message->head.channel_id) + " is unknown");
  });
}

std::optional<Message> Reader::next() {
  while (!rest_.empty()) {
    std::uint8_t opcode = 0;
    std::uint64_t length = 0;
    FieldReader fields(rest_);
    fields(opcode, length);  // checked by load_chunk()
    const auto content = fields.rest().first(static_cast<std::size_t>(length));
    rest_ = fields.rest().subspan(content.size());
    if (static_cast<Opcode>(opcode) != Opcode::Message) continue;
    return *parse_message({Opcode::Message, content, 0});
  }
  return std::nullopt;
}

FileResult<Attachment> Reader::attachment(std::size_t number) {
  const AttachmentIndex& index = summary_.attachments.at(number);
  auto view = load_listed(file_, Opcode::Attachment, index.offset, index.length, limits_, stored_);
  if (!view) return error_of(view);
  std::span<const std::byte> data;
  auto head = parse_attachment(*view, data);
  if (!head) return file_.named(head.error());
  if (head->name == index.name) {
    return Attachment{head->log_time, head->create_time, head->name, head->media_type,
                      Bytes(data.begin(), data.end())};
  }
  return file_.named(
      {0, place_of(Opcode::Attachment, index.offset) + ": another name than in the summary"});
}

FileResult<Metadata> Reader::metadata(std::size_t number) {
  const MetadataIndex& index = summary_.metadata.at(number);
  auto view = load_listed(file_, Opcode::Metadata, index.offset, index.length, limits_, stored_);
  if (!view) return error_of(view);
  auto metadata = parse<Metadata>(*view);
  if (!metadata) return file_.named(metadata.error());
  return metadata;
}

}  // namespace orbwatch::hal::mcap
