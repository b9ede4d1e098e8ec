// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <chrono>
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <vector>

#include "app/model/sink/recorded_texts.h"
#include "app/model/status/alarm_notice.h"
#include "app/model/status/status_report.h"
#include "app/ports/recorder/messages.h"
#include "hal/mcap/writer.h"

namespace orbwatch::app::recorder {

/// A recording that is being written: process states and events, with the configuration that they
/// were measured with. What was written since the last flush() is lost with the power.
/// Thread-bound; waits for the disk.
class LogFile {
 public:
  /// Creates the file with its attachments. Errors: of the disk.
  static hal::mcap::FileResult<LogFile> create(const std::filesystem::path& path,
                                               const RecordedTexts& texts, Utc now);

  hal::mcap::FileResult<> write_state(const StatusReport& report);
  hal::mcap::FileResult<> write_event(const AlarmNotice& notice, const StatusNames& names,
                                      Utc stamp);

  /// Hands everything to the disk, and waits until it is there.
  hal::mcap::FileResult<> flush();
  hal::mcap::FileResult<> finish() { return writer_.finish(); }

  const std::filesystem::path& path() const { return path_; }
  std::uint64_t size() const { return writer_.size(); }

 private:
  LogFile(std::filesystem::path path, hal::mcap::Writer writer)
      : path_(std::move(path)), writer_(std::move(writer)) {}

  hal::mcap::FileResult<> write(std::uint16_t channel, Utc stamp);

  std::filesystem::path path_;
  hal::mcap::Writer writer_;
  std::uint16_t states_ = 0, events_ = 0;  ///< channels
  std::uint32_t sequence_ = 0;
  std::vector<std::byte> message_;  ///< reused
};

}  // namespace orbwatch::app::recorder
