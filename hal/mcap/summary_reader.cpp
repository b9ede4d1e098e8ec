// SPDX-License-Identifier: Apache-2.0
#include "hal/mcap/summary_reader.h"

#include <algorithm>
#include <array>
#include <utility>

#include "hal/mcap/crc32.h"
#include "hal/mcap/names.h"

namespace orbwatch::hal::mcap {
namespace {

/// First byte behind the magic and the shortest header.
constexpr std::uint64_t kDataBegin = kMagic.size() + kRecordHead;

/// Footer and magic at the end of the file.
constexpr std::size_t kFileEnd = kFooterSize + kMagic.size();

/// A part of the data section that an index names.
struct Extent {
  std::uint64_t begin = 0;
  std::uint64_t length = 0;
  Opcode opcode{};
};

FileResult<> check_chunk(const ChunkIndex& chunk, const Summary& summary, std::uint64_t at,
                         const Limits& limits) {
  const std::string place = place_of(Opcode::ChunkIndex, at);
  if (chunk.uncompressed_size > limits.chunk || chunk.length > most_stored(limits)) {
    return refuse(place + ": a chunk of " +
                  std::to_string(std::max(chunk.uncompressed_size, chunk.length)) +
                  " bytes; at most " + std::to_string(limits.chunk));
  }
  const std::uint64_t begin = chunk.offset + chunk.length;
  for (const auto& [channel, offset] : chunk.message_index_offsets) {
    if (!summary.channels.contains(channel)) {
      return refuse(place + ": channel " + std::to_string(channel) + " is unknown");
    }
    if (offset < begin || offset - begin >= chunk.message_index_length) {
      return refuse(place + ": a message index at byte " + std::to_string(offset) +
                    "; it must be behind its chunk");
    }
  }
  return {};
}

/// Reads the records of one summary, in the order in which they stand.
class SummaryRecords {
 public:
  explicit SummaryRecords(const Limits& limits) : limits_(limits) {}

  FileResult<> add(const RecordView& view) {
    switch (view.opcode) {
      case Opcode::Schema:
        return define(parse<Schema>(view), view.offset);
      case Opcode::Channel:
        return define(parse<Channel>(view), view.offset);
      case Opcode::ChunkIndex:
        return add_chunk(view);
      case Opcode::AttachmentIndex:
        return add_attachment(view);
      case Opcode::MetadataIndex:
        return add_metadata(view);
      case Opcode::Statistics:
        return add_statistics(view);
      default:
        return {};  // of a later version of MCAP, or private
    }
  }

  /// The summary, when all its parts lie in the data section and none over another.
  FileResult<Summary> finish(std::uint64_t data_end);

 private:
  template <class Record>
  FileResult<> define(FileResult<Record> record, std::uint64_t offset) {
    if (!record) return error_of(record);
    return summary_.add(std::move(*record), offset);
  }
  FileResult<> add_chunk(const RecordView& view);
  FileResult<> add_attachment(const RecordView& view);
  FileResult<> add_metadata(const RecordView& view);
  FileResult<> add_statistics(const RecordView& view);

  const Limits& limits_;
  Summary summary_;
  std::vector<Extent> extents_;
  std::optional<std::uint32_t> chunk_count_;
};

FileResult<> SummaryRecords::add_chunk(const RecordView& view) {
  auto chunk = parse<ChunkIndex>(view);
  if (!chunk) return error_of(chunk);
  if (auto checked = check_chunk(*chunk, summary_, view.offset, limits_); !checked) return checked;
  if (chunk->message_index_length > limits_.chunk) {
    return refuse(place_of(view.opcode, view.offset) + ": message indexes of " +
                  std::to_string(chunk->message_index_length) + " bytes; at most " +
                  std::to_string(limits_.chunk));
  }
  extents_.push_back({chunk->offset, chunk->length + chunk->message_index_length, Opcode::Chunk});
  summary_.chunks.push_back(std::move(*chunk));
  return {};
}

FileResult<> SummaryRecords::add_attachment(const RecordView& view) {
  auto index = parse<AttachmentIndex>(view);
  if (!index) return error_of(index);
  const std::string place = place_of(view.opcode, view.offset);
  if (index->length > limits_.attachment) {
    return refuse(place + ": an attachment of " + std::to_string(index->length) +
                  " bytes; at most " + std::to_string(limits_.attachment));
  }
  if (auto checked = check_attachment_name(place, index->name); !checked) return checked;
  extents_.push_back({index->offset, index->length, Opcode::Attachment});
  summary_.attachments.push_back(std::move(*index));
  return {};
}

FileResult<> SummaryRecords::add_metadata(const RecordView& view) {
  auto index = parse<MetadataIndex>(view);
  if (!index) return error_of(index);
  const std::string place = place_of(view.opcode, view.offset);
  if (index->length > limits_.attachment) {
    return refuse(place + ": metadata of " + std::to_string(index->length) + " bytes; at most " +
                  std::to_string(limits_.attachment));
  }
  if (auto checked = check_name(place, index->name); !checked) return checked;
  extents_.push_back({index->offset, index->length, Opcode::Metadata});
  summary_.metadata.push_back(std::move(*index));
  return {};
}

FileResult<> SummaryRecords::add_statistics(const RecordView& view) {
  auto statistics = parse<Statistics>(view);
  if (!statistics) return error_of(statistics);
  for (const auto& [channel, count] : statistics->message_counts) {
    if (!summary_.channels.contains(channel)) {
      return refuse(place_of(view.opcode, view.offset) + ": channel " + std::to_string(channel) +
                    " is unknown; channels must stand before the statistics");
    }
    if (count > 0) summary_.message_counts[channel] = count;
  }
  chunk_count_ = statistics->chunk_count;
  return {};
}

FileResult<Summary> SummaryRecords::finish(std::uint64_t data_end) {
  if (chunk_count_ && *chunk_count_ != summary_.chunks.size()) {
    return refuse("the summary lists " + std::to_string(summary_.chunks.size()) + " chunks of " +
                  std::to_string(*chunk_count_));
  }
  std::ranges::sort(extents_, {}, &Extent::begin);
  std::uint64_t free = kDataBegin;
  for (const Extent& extent : extents_) {
    if (extent.begin < free || extent.begin > data_end || extent.length > data_end - extent.begin ||
        extent.length < kRecordHead) {
      return refuse("the summary lists a " + place_of(extent.opcode, extent.begin) + ", " +
                    std::to_string(extent.length) + " bytes long; it must lie between byte " +
                    std::to_string(free) + " and the end of the data at byte " +
                    std::to_string(data_end));
    }
    free = extent.begin + extent.length;
  }
  std::ranges::sort(summary_.chunks, {}, &ChunkIndex::offset);
  std::ranges::sort(summary_.attachments, {}, &AttachmentIndex::offset);
  std::ranges::sort(summary_.metadata, {}, &MetadataIndex::offset);
  return std::move(summary_);
}

/// The footer, if the file ends with one.
FileResult<std::optional<Footer>> read_footer(const File& file, std::uint64_t size) {
  if (size < kDataBegin + kFileEnd) return std::nullopt;
  std::array<std::byte, kFileEnd> end;
  if (auto done = file.read(size - kFileEnd, end); !done) return error_of(done);
  if (!std::ranges::equal(std::span(end).last(kMagic.size()), kMagic)) return std::nullopt;
  std::uint8_t opcode = 0;
  std::uint64_t length = 0;
  Footer footer;
  const std::span<const std::byte> bytes(end);
  FieldReader fields(bytes.first(kFooterSize));
  if (!fields(opcode, length) || !Footer::visit(footer, fields)) return std::nullopt;
  const bool is_footer =
      opcode == static_cast<std::uint8_t>(Opcode::Footer) && length == kFooterSize - kRecordHead;
  return is_footer ? std::optional(footer) : std::nullopt;
}

}  // namespace

FileResult<std::optional<SummarySection>> find_summary(const File& file, const Limits& limits) {
  const auto size = file.size();
  if (!size) return tl::unexpected(size.error());
  auto footer = read_footer(file, *size);
  if (!footer) return error_of(footer);
  if (!*footer || (*footer)->summary_start == 0) return std::nullopt;
  const std::uint64_t at = *size - kFileEnd;
  const std::uint64_t begin = (*footer)->summary_start;
  const std::uint64_t stated = (*footer)->summary_offset_start;
  const std::uint64_t offsets = stated == 0 ? at : stated;
  const std::string place = place_of(Opcode::Footer, at);
  if (begin < kDataBegin + kDataEndSize || begin > offsets || offsets > at) {
    return file.named({0, place + ": a summary at byte " + std::to_string(begin) +
                              " with offsets at byte " + std::to_string(offsets) +
                              "; they must lie in this order between the data and the footer"});
  }
  if (at - begin > limits.summary) {
    return file.named({0, place + ": a summary of " + std::to_string(at - begin) +
                              " bytes; at most " + std::to_string(limits.summary)});
  }
  SummarySection section{begin, offsets, {}};
  section.bytes.resize(static_cast<std::size_t>(at + kFooterSize - sizeof(std::uint32_t) - begin));
  if (auto done = file.read(begin, section.bytes); !done) return error_of(done);
  const std::uint32_t crc = (*footer)->summary_crc;
  if (crc != 0 && crc32_of(section.bytes) != crc) return std::nullopt;
  return section;
}

FileResult<Summary> read_summary(const File& file, const SummarySection& section,
                                 const Limits& limits) {
  SummaryRecords records(limits);
  const auto listed =
      std::span(section.bytes).first(static_cast<std::size_t>(section.offsets - section.begin));
  auto done = for_each_record(listed, section.begin,
                              [&](const RecordView& view) { return records.add(view); });
  if (!done) return file.named(done.error());
  auto summary = records.finish(section.data_end());
  if (!summary) return file.named(summary.error());
  return summary;
}

}  // namespace orbwatch::hal::mcap
