// SPDX-License-Identifier: Apache-2.0
#include "hal/mcap/summary.h"

#include <algorithm>
#include <utility>

#include "hal/mcap/crc32.h"
#include "hal/mcap/names.h"

namespace orbwatch::hal::mcap {
namespace {

/// Enters a definition under its id, unless it is there.
template <class Record>
FileResult<> enter(std::map<std::uint16_t, Record>& records, Record record,
                   const std::string& place) {
  const auto [known, is_new] = records.try_emplace(record.id, std::move(record));
  if (is_new || known->second == record) return {};
  return refuse(place + ": id " + std::to_string(record.id) +
                " was defined differently before; a definition must not change");
}

/// Appends one group of summary records, and its place for the summary offsets.
template <class Range, class Get>
void append_group(Bytes& out, std::uint64_t data_end, const Range& range, Get get,
                  std::vector<SummaryOffset>& offsets) {
  const std::size_t begin = out.size();
  for (const auto& entry : range) append_record(out, get(entry));
  if (out.size() == begin) return;
  offsets.push_back(
      {std::to_integer<std::uint8_t>(out[begin]), data_end + begin, out.size() - begin});
}

}  // namespace

FileResult<> Summary::add(Schema schema, std::uint64_t offset) {
  const std::string place = place_of(Opcode::Schema, offset);
  if (schema.id == 0) return refuse(place + ": id 0; ids of schemas begin at 1");
  if (auto checked = check_name(place, schema.name); !checked) return checked;
  return enter(schemas, std::move(schema), place);
}

FileResult<> Summary::add(Channel channel, std::uint64_t offset) {
  const std::string place = place_of(Opcode::Channel, offset);
  if (auto checked = check_name(place, channel.topic); !checked) return checked;
  if (channel.schema_id != 0 && !schemas.contains(channel.schema_id)) {
    return refuse(place + ": schema " + std::to_string(channel.schema_id) +
                  " is unknown; a schema must be defined before its channels");
  }
  return enter(channels, std::move(channel), place);
}

Statistics Summary::statistics() const {
  Statistics statistics;
  statistics.schema_count = static_cast<std::uint16_t>(schemas.size());
  statistics.channel_count = static_cast<std::uint32_t>(channels.size());
  statistics.attachment_count = static_cast<std::uint32_t>(attachments.size());
  statistics.metadata_count = static_cast<std::uint32_t>(metadata.size());
  statistics.chunk_count = static_cast<std::uint32_t>(chunks.size());
  for (const auto& [channel, count] : message_counts) {
    statistics.message_count += count;
    statistics.message_counts.emplace_back(channel, count);
  }
  bool has_time = false;
  for (const ChunkIndex& chunk : chunks) {
    if (chunk.message_end_time == 0) continue;  // no messages
    const std::uint64_t start = chunk.message_start_time;
    statistics.message_start_time =
        has_time ? std::min(statistics.message_start_time, start) : start;
    statistics.message_end_time = std::max(statistics.message_end_time, chunk.message_end_time);
    has_time = true;
  }
  return statistics;
}

void append_end(Bytes& out, const Summary& summary, std::uint64_t data_end,
                std::uint32_t data_crc) {
  const std::size_t first = out.size();
  data_end -= first;  // offset of out's first byte
  append_record(out, DataEnd{data_crc});
  const std::size_t begin = out.size();
  const auto itself = [](const auto& record) -> const auto& { return record; };
  const auto value = [](const auto& entry) -> const auto& { return entry.second; };
  std::vector<SummaryOffset> offsets;
  append_group(out, data_end, summary.schemas, value, offsets);
  append_group(out, data_end, summary.channels, value, offsets);
  append_group(out, data_end, std::array{summary.statistics()}, itself, offsets);
  append_group(out, data_end, summary.chunks, itself, offsets);
  append_group(out, data_end, summary.attachments, itself, offsets);
  append_group(out, data_end, summary.metadata, itself, offsets);
  Footer footer{data_end + begin, data_end + out.size(), 0};
  for (const SummaryOffset& offset : offsets) append_record(out, offset);
  append_record(out, footer);
  const std::size_t crc = out.size() - sizeof(footer.summary_crc);
  FieldWriter(out).set(crc, crc32_of(std::span(out).subspan(begin, crc - begin)));
  out.insert(out.end(), kMagic.begin(), kMagic.end());
}

}  // namespace orbwatch::hal::mcap
