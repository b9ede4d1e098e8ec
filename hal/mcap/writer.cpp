// SPDX-License-Identifier: Apache-2.0
#include "hal/mcap/writer.h"

#include <algorithm>
#include <cerrno>
#include <utility>

#include "hal/atomic_file.h"
#include "hal/mcap/crc32.h"
#include "hal/mcap/names.h"

namespace orbwatch::hal::mcap {
namespace {

/// Bytes of a record.
template <class Record>
Bytes encoded(const Record& record) {
  Bytes bytes;
  append_record(bytes, record);
  return bytes;
}

/// Checks texts that a Reader bounds.
FileResult<> check_entries(const std::string& what, const StringMap& entries) {
  if (entries.size() <= kMostMapEntries) return {};
  return refuse(what + ": " + std::to_string(entries.size()) + " entries; at most " +
                std::to_string(kMostMapEntries));
}

/// Free id above those in use; 0: there is none.
template <class Record>
std::uint16_t next_id(const std::map<std::uint16_t, Record>& records) {
  return static_cast<std::uint16_t>(records.empty() ? 1 : records.rbegin()->first + 1);
}

}  // namespace

Writer::Writer(File file, const WriterSettings& settings)
    : file_(std::move(file)), settings_(settings), chunk_(settings.chunk), zstd_(settings.level) {}

FileResult<Writer> Writer::create(const std::filesystem::path& path,
                                  const WriterSettings& settings) {
  if (settings.chunk == 0 || settings.chunk > Limits{}.chunk) {
    return failed(EINVAL, "a chunk of " + std::to_string(settings.chunk) + " bytes");
  }
  auto file = File::open(path, File::Access::Create);
  if (!file) return error_of(file);
  Writer writer(std::move(*file), settings);
  const Bytes header = encoded(settings.header);
  auto begun = writer.append({kMagic, header});
  if (begun) begun = writer.sync();
  if (begun) {
    // A folder that cannot be synced is no reason not to record.
    static_cast<void>(sync_folder(path.parent_path()));
    return writer;
  }
  std::error_code ignored;
  std::filesystem::remove(path, ignored);
  return error_of(begun);
}

FileResult<std::uint16_t> Writer::add_schema(Schema schema) {
  const std::string what = "schema " + std::to_string(schemas_.size() + 1);
  if (auto checked = check_name(what, schema.name); !checked) return error_of(checked);
  schema.id = next_id(schemas_);
  if (schema.id == 0) return failed(EOVERFLOW, what);
  if (auto checked = check_summary(encoded(schema).size()); !checked) return error_of(checked);
  return schemas_.emplace(schema.id, std::move(schema)).first->first;
}

FileResult<std::uint16_t> Writer::add_channel(Channel channel) {
  const std::string what = "channel " + std::to_string(channels_.size() + 1);
  if (auto checked = check_name(what, channel.topic); !checked) return error_of(checked);
  if (auto checked = check_entries(what, channel.metadata); !checked) return error_of(checked);
  if (channel.schema_id != 0 && !schemas_.contains(channel.schema_id)) {
    return failed(EINVAL, what + " of an unknown schema");
  }
  channel.id = next_id(channels_);
  if (channel.id == 0) return failed(EOVERFLOW, what);
  return channels_.emplace(channel.id, std::move(channel)).first->first;
}

Bytes Writer::definitions_of(const Channel& channel) const {
  Bytes bytes;
  const auto has_schema = [&](std::uint16_t id) {
    return channels_.at(id).schema_id == channel.schema_id;
  };
  const bool is_defined = channel.schema_id == 0 || summary_.schemas.contains(channel.schema_id) ||
                          std::ranges::any_of(new_channels_, has_schema);
  if (!is_defined) append_record(bytes, schemas_.at(channel.schema_id));
  append_record(bytes, channel);
  return bytes;
}

FileResult<> Writer::write(const MessageHead& head, std::span<const std::byte> data) {
  const auto channel = channels_.find(head.channel_id);
  if (channel == channels_.end()) {
    return failed(EINVAL, "message of channel " + std::to_string(head.channel_id));
  }
  const bool is_defined = summary_.channels.contains(head.channel_id) ||
                          std::ranges::find(new_channels_, head.channel_id) != new_channels_.end();
  const Bytes definitions = is_defined ? Bytes() : definitions_of(channel->second);
  if (definitions.size() + kMessageSize > chunk_.room() ||
      data.size() > chunk_.room() - definitions.size() - kMessageSize) {
    return failed(EMSGSIZE, "message of " + std::to_string(data.size()) +
                                " bytes in a chunk with " + std::to_string(chunk_.room()) +
                                " bytes left");
  }
  chunk_.append(definitions);
  definition_bytes_ += definitions.size();
  if (!is_defined) new_channels_.push_back(head.channel_id);
  chunk_.append(head, data);
  return {};
}

FileResult<> Writer::flush() {
  if (chunk_.is_empty()) return {};
  auto index = write_chunk();
  if (index) {
    for (const std::uint16_t id : new_channels_) {
      const Channel& channel = channels_.at(id);
      summary_.channels.emplace(id, channel);
      if (channel.schema_id == 0 || summary_.schemas.contains(channel.schema_id)) continue;
      summary_.schemas.emplace(channel.schema_id, schemas_.at(channel.schema_id));
    }
    chunk_.indexes().for_each([this](const MessageIndex& messages) {
      summary_.message_counts[messages.channel_id] += messages.messages.size();
    });
    summary_bytes_ += encoded(*index).size() + definition_bytes_;
    summary_.chunks.push_back(std::move(*index));
  }
  new_channels_.clear();
  definition_bytes_ = 0;
  chunk_.clear();
  if (index) return {};
  return error_of(index);
}

FileResult<ChunkIndex> Writer::write_chunk() {
  auto stored = FileResult<std::span<const std::byte>>(chunk_.records());
  if (settings_.is_compressed) stored = zstd_.encode(chunk_.records());
  if (!stored) return file_.named(stored.error());
  const MessageIndexes& indexes = chunk_.indexes();
  const ChunkHead head{indexes.start_time(),
                       indexes.end_time(),
                       chunk_.records().size(),
                       crc32_of(chunk_.records()),
                       settings_.is_compressed ? kZstd : "",
                       stored->size()};
  Bytes front;
  append_record(front, head, stored->size());
  ChunkIndex index{head.message_start_time,
                   head.message_end_time,
                   end_,
                   front.size() + stored->size(),
                   {},
                   0,
                   head.compression,
                   stored->size(),
                   head.uncompressed_size};
  Bytes behind;
  indexes.append_to(behind, end_ + index.length, index);
  const std::size_t more = encoded(index).size() + definition_bytes_;
  if (auto checked = check_summary(more); !checked) return error_of(checked);
  if (auto written = append({front, *stored, behind}); !written) return error_of(written);
  return index;
}

FileResult<> Writer::check_summary(std::size_t more) const {
  // The rest is for statistics, summary offsets and footer.
  const std::size_t rest = 1024 + 10 * channels_.size();
  if (summary_bytes_ + more + rest <= Limits{}.summary) return {};
  return failed(EFBIG, file_.name() + ": the summary has reached its limit");
}

FileResult<> Writer::attach(const Attachment& attachment) {
  const std::string what = "attachment";
  if (auto checked = check_attachment_name(what, attachment.name); !checked) return checked;
  Bytes record;
  append_attachment(record, attachment);
  if (record.size() > Limits{}.attachment) {
    return failed(EFBIG, what + " of " + std::to_string(attachment.data.size()) + " bytes");
  }
  AttachmentIndex index{end_,
                        record.size(),
                        attachment.log_time,
                        attachment.create_time,
                        attachment.data.size(),
                        attachment.name,
                        attachment.media_type};
  const std::size_t more = encoded(index).size();
  if (auto checked = check_summary(more); !checked) return checked;
  if (auto written = append({record}); !written) return written;
  summary_bytes_ += more;
  summary_.attachments.push_back(std::move(index));
  return {};
}

FileResult<> Writer::add_metadata(const Metadata& metadata) {
  const std::string what = "metadata";
  if (auto checked = check_name(what, metadata.name); !checked) return checked;
  if (auto checked = check_entries(what, metadata.entries); !checked) return checked;
  const Bytes record = encoded(metadata);
  if (record.size() > Limits{}.attachment) {
    return failed(EFBIG, what + " of " + std::to_string(record.size()) + " bytes");
  }
  MetadataIndex index{end_, record.size(), metadata.name};
  const std::size_t more = encoded(index).size();
  if (auto checked = check_summary(more); !checked) return checked;
  if (auto written = append({record}); !written) return written;
  summary_bytes_ += more;
  summary_.metadata.push_back(std::move(index));
  return {};
}

FileResult<> Writer::finish() {
  if (auto flushed = flush(); !flushed) return flushed;
  Bytes end;
  append_end(end, summary_, end_, crc_);
  return file_.replace_end(end_, end);
}

FileResult<> Writer::append(std::initializer_list<std::span<const std::byte>> parts) {
  auto written = file_.write(end_, parts);
  if (!written) {
    // If this fails as well, readers find a torn record, which the next write replaces.
    static_cast<void>(file_.truncate(end_));
    return written;
  }
  for (const auto part : parts) {
    crc_ = crc32_of(part, crc_);
    end_ += part.size();
  }
  return {};
}

}  // namespace orbwatch::hal::mcap
