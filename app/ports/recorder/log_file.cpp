// SPDX-License-Identifier: Apache-2.0
#include "app/ports/recorder/log_file.h"

#include <algorithm>
#include <span>
#include <string>
#include <string_view>

#include "app/ports/dds/generated/message_schemas.h"
#include "hal/mcap/cdr.h"

namespace orbwatch::app::recorder {
namespace {

using hal::mcap::FileResult;
using hal::mcap::Writer;

std::uint64_t nanoseconds(Utc moment) {
  return static_cast<std::uint64_t>(
      std::chrono::duration_cast<std::chrono::nanoseconds>(moment.time_since_epoch()).count());
}

/// Channel of a topic whose messages have this type of ROS 2.
FileResult<std::uint16_t> add_topic(Writer& writer, std::string_view topic, std::string_view type) {
  const auto* const schema =
      std::ranges::find(dds::kMessageSchemas, type, &dds::MessageSchema::name);
  hal::mcap::Schema definition;
  definition.name = type;
  definition.data = schema->definition;
  return writer.add_schema(std::move(definition)).and_then([&](std::uint16_t id) {
    hal::mcap::Channel channel;
    channel.schema_id = id;
    channel.topic = topic;
    return writer.add_channel(std::move(channel));
  });
}

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

FileResult<LogFile> LogFile::create(const std::filesystem::path& path, const RecordedTexts& texts,
                                    Utc now) {
  hal::mcap::WriterSettings settings;
  settings.level = 3;
  auto writer = Writer::create(path, settings);
  if (!writer) return hal::mcap::error_of(writer);
  LogFile file(path, std::move(*writer));
  const auto ready =
      attach(file.writer_, texts, now)
          .and_then([&] {
            return add_topic(file.writer_, "/orbwatch/process_state",
                             "orbwatch_msgs/msg/ProcessState");
          })
          .and_then([&](std::uint16_t channel) {
            file.states_ = channel;
            return add_topic(file.writer_, "/orbwatch/event", "orbwatch_msgs/msg/Event");
          })
          .map([&](std::uint16_t channel) { file.events_ = channel; });
  if (!ready) return tl::unexpected(ready.error());
  return file;
}

FileResult<> LogFile::write_state(const StatusReport& report) {
  hal::mcap::encode_cdr(process_state_of(report), message_);
  return write(states_, report.stamp);
}

FileResult<> LogFile::write_event(const AlarmNotice& notice, const StatusNames& names, Utc stamp) {
  hal::mcap::encode_cdr(event_of(notice, names, stamp), message_);
  return write(events_, stamp);
}

FileResult<> LogFile::write(std::uint16_t channel, Utc stamp) {
  const std::uint64_t time = nanoseconds(stamp);
  return writer_.write({channel, ++sequence_, time, time}, message_);
}

FileResult<> LogFile::flush() {
  return writer_.flush().and_then([this] { return writer_.sync(); });
}

}  // namespace orbwatch::app::recorder
