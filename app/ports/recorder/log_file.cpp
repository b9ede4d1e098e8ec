// SPDX-License-Identifier: Apache-2.0
#include "app/ports/recorder/log_file.h"

#include <algorithm>
#include <cerrno>
#include <span>
#include <utility>

#include "app/ports/dds/generated/message_schemas.h"
#include "hal/mcap/cdr.h"

namespace orbwatch::app::recorder {
namespace {

using hal::mcap::FileResult;
using hal::mcap::Writer;

FileResult<> attach(Writer& writer, const RecordedTexts& texts, Utc now) {
  for (const auto& [name, text] : texts.files) {
    hal::mcap::Attachment attachment{nanoseconds(now), 0, name, "application/toml", {}};
    const auto bytes = std::as_bytes(std::span(text));
    attachment.data.assign(bytes.begin(), bytes.end());
    if (auto attached = writer.attach(attachment); !attached) return attached;
  }
  hal::mcap::Metadata versions;
  versions.name = "versions";
  versions.entries = texts.versions;
  return writer.add_metadata(versions);
}

}  // namespace

std::uint64_t nanoseconds(Utc moment) {
  return static_cast<std::uint64_t>(
      std::chrono::duration_cast<std::chrono::nanoseconds>(moment.time_since_epoch()).count());
}

LogMessage state_message(const StatusReport& report) {
  LogMessage message{false, report.status.stamp, report.stamp, {}};
  hal::mcap::encode_cdr(process_state_of(report), message.bytes);
  return message;
}

LogMessage event_message(const AlarmNotice& notice, const StatusNames& names, Utc utc) {
  LogMessage message{true, notice.stamp, utc, {}};
  hal::mcap::encode_cdr(event_of(notice, names, utc), message.bytes);
  return message;
}

FileResult<LogFile> LogFile::create(const std::filesystem::path& path, const RecordedTexts& texts,
                                    Utc now, int level) {
  hal::mcap::WriterSettings settings;
  settings.level = level;
  auto writer = Writer::create(path, settings);
  if (!writer) return hal::mcap::error_of(writer);
  LogFile file(path, std::move(*writer));
  const auto ready =
      attach(file.writer_, texts, now)
          .and_then([&] {
            return file.add_topic("/orbwatch/process_state", "orbwatch_msgs/msg/ProcessState");
          })
          .and_then([&](std::uint16_t channel) {
            file.states_ = channel;
            return file.add_topic("/orbwatch/event", "orbwatch_msgs/msg/Event");
          })
          .map([&](std::uint16_t channel) { file.events_ = channel; });
  if (!ready) return tl::unexpected(ready.error());
  return file;
}

FileResult<std::uint16_t> LogFile::add_topic(std::string topic, std::string_view type,
                                             hal::mcap::StringMap metadata) {
  const auto* const schema =
      std::ranges::find(dds::kMessageSchemas, type, &dds::MessageSchema::name);
  hal::mcap::Schema definition;
  definition.name = type;
  definition.data = schema->definition;
  return writer_.add_schema(std::move(definition)).and_then([&](std::uint16_t id) {
    hal::mcap::Channel channel;
    channel.schema_id = id;
    channel.topic = std::move(topic);
    channel.metadata = std::move(metadata);
    return writer_.add_channel(std::move(channel));
  });
}

FileResult<> LogFile::write(const LogMessage& message) {
  const std::uint64_t time = nanoseconds(message.utc);
  return write({message.is_event ? events_ : states_, ++sequence_, time, time}, message.bytes);
}

FileResult<> LogFile::write(const hal::mcap::MessageHead& head,
                            std::span<const std::byte> message) {
  auto written = writer_.write(head, message);
  if (written || written.error().number != EMSGSIZE) return written;
  return writer_.flush().and_then([&] { return writer_.write(head, message); });
}

FileResult<> LogFile::flush() {
  return writer_.flush().and_then([this] { return writer_.sync(); });
}

}  // namespace orbwatch::app::recorder
