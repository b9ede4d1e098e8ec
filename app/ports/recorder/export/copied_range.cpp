// SPDX-License-Identifier: Apache-2.0
#include "app/ports/recorder/export/copied_range.h"

#include <cerrno>
#include <cstdint>
#include <map>
#include <utility>

#include "hal/mcap/reader.h"
#include "hal/mcap/writer.h"

namespace orbwatch::app::recorder {
namespace {

using hal::mcap::FileResult;
using hal::mcap::Reader;
using hal::mcap::Writer;

/// Copies a recording part by part.
class RangeCopy {
 public:
  RangeCopy(Reader& reader, Writer& writer) : reader_(reader), writer_(writer) {}

  /// Defines all channels; the writer leaves out those without a message.
  FileResult<> define_channels() {
    std::map<std::uint16_t, std::uint16_t> schemas{{0, 0}};
    for (const auto& [id, schema] : reader_.summary().schemas) {
      auto added = writer_.add_schema(schema);
      if (!added) return hal::mcap::error_of(added);
      schemas.emplace(id, *added);
    }
    for (const auto& [id, known] : reader_.summary().channels) {
      hal::mcap::Channel channel = known;
      channel.schema_id = schemas.at(channel.schema_id);
      auto added = writer_.add_channel(std::move(channel));
      if (!added) return hal::mcap::error_of(added);
      channels_.emplace(id, *added);
    }
    return {};
  }

  FileResult<> copy_attachments() {
    for (std::size_t k = 0; k < reader_.summary().attachments.size(); ++k) {
      const auto copied = reader_.attachment(k).and_then(
          [this](const hal::mcap::Attachment& attachment) { return writer_.attach(attachment); });
      if (!copied) return copied;
    }
    for (std::size_t k = 0; k < reader_.summary().metadata.size(); ++k) {
      const auto copied = reader_.metadata(k).and_then(
          [this](const hal::mcap::Metadata& metadata) { return writer_.add_metadata(metadata); });
      if (!copied) return copied;
    }
    return {};
  }

  /// Copies what is in the range as a chunk of its own.
  FileResult<> copy_chunk(std::size_t number, const StampRange& range) {
    if (auto loaded = reader_.load_chunk(number); !loaded) return loaded;
    while (const auto message = reader_.next()) {
      if (!range.has(message->head.log_time)) continue;
      if (auto copied = copy(*message); !copied) return copied;
    }
    return writer_.flush();
  }

 private:
  FileResult<> copy(const hal::mcap::Message& message) {
    hal::mcap::MessageHead head = message.head;
    head.channel_id = channels_.at(head.channel_id);
    auto written = writer_.write(head, message.data);
    if (written || written.error().number != EMSGSIZE) return written;
    return writer_.flush().and_then([&] { return writer_.write(head, message.data); });
  }

  Reader& reader_;
  Writer& writer_;
  std::map<std::uint16_t, std::uint16_t> channels_;  ///< ids there by ids here
};

/// False: cancelled.
FileResult<bool> copy_all(Reader& reader, Writer& writer, const StampRange& range,
                          const ExportSteps& steps) {
  RangeCopy copy(reader, writer);
  auto begun = copy.define_channels().and_then([&] { return copy.copy_attachments(); });
  if (!begun) return hal::mcap::error_of(begun);
  const std::size_t chunks = reader.summary().chunks.size();
  for (std::size_t k = 0; k < chunks; ++k) {
    if (!steps(k, chunks, "chunks")) return false;
    if (auto copied = copy.copy_chunk(k, range); !copied) return hal::mcap::error_of(copied);
  }
  return writer.finish().map([] { return true; });
}

}  // namespace

Result<> copy_range(const std::filesystem::path& recording, const StampRange& range,
                    const std::filesystem::path& output, const ExportSteps& steps) {
  auto reader = Reader::open(recording);
  if (!reader) return fail(reader.error().message);
  hal::mcap::WriterSettings settings;
  settings.header = reader->header();
  settings.chunk = hal::mcap::Limits{}.chunk;
  auto writer = Writer::create(output, settings);
  if (!writer) return fail(writer.error().message);
  const auto is_whole = copy_all(*reader, *writer, range, steps);
  if (!is_whole) return fail(is_whole.error().message);
  if (!*is_whole) return cancelled_export();
  return {};
}

}  // namespace orbwatch::app::recorder
