// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <chrono>
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "app/model/sink/recorded_texts.h"
#include "app/model/status/alarm_notice.h"
#include "app/model/status/status_report.h"
#include "app/ports/recorder/messages.h"
#include "hal/clock.h"
#include "hal/mcap/writer.h"

namespace orbwatch::app::recorder {

/// Moment in recordings: nanoseconds of UTC since 1970.
std::uint64_t nanoseconds(Utc moment);

/// A process state or an event, encoded once for all recordings that it is in.
struct LogMessage {
  bool is_event = false;
  hal::TimePoint stamp;  ///< of the frame set
  Utc utc{};             ///< the same
  std::vector<std::byte> bytes;
};

/// Reentrant.
LogMessage state_message(const StatusReport& report);
LogMessage event_message(const AlarmNotice& notice, const StatusNames& names, Utc utc);

/// A recording that is being written: process states and events, with the configuration that they
/// were measured with. What was written since the last flush() is lost with the power.
/// Thread-bound; waits for the disk.
class LogFile {
 public:
  /// Creates the file with its attachments. `level`: of zstd. Errors: of the disk.
  static hal::mcap::FileResult<LogFile> create(const std::filesystem::path& path,
                                               const RecordedTexts& texts, Utc now, int level = 3);

  /// Adds a channel whose messages have this type of ROS 2.
  hal::mcap::FileResult<std::uint16_t> add_topic(std::string topic, std::string_view type,
                                                 hal::mcap::StringMap metadata = {});

  hal::mcap::FileResult<> add_metadata(const hal::mcap::Metadata& metadata) {
    return writer_.add_metadata(metadata);
  }

  hal::mcap::FileResult<> write(const LogMessage& message);
  /// Writes any message; one that the chunk has no room for begins another.
  hal::mcap::FileResult<> write(const hal::mcap::MessageHead& head,
                                std::span<const std::byte> message);

  /// Hands everything to the disk, and waits until it is there.
  hal::mcap::FileResult<> flush();
  hal::mcap::FileResult<> finish() { return writer_.finish(); }

  const std::filesystem::path& path() const { return path_; }
  std::uint64_t size() const { return writer_.size(); }

 private:
  LogFile(std::filesystem::path path, hal::mcap::Writer writer)
      : path_(std::move(path)), writer_(std::move(writer)) {}

  std::filesystem::path path_;
  hal::mcap::Writer writer_;
  std::uint16_t states_ = 0, events_ = 0;  ///< channels
  std::uint32_t sequence_ = 0;
};

}  // namespace orbwatch::app::recorder
