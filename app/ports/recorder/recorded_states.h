// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <utility>

#include "app/ports/recorder/messages.h"
#include "hal/mcap/reader.h"
#include "proc/image/result.h"

namespace orbwatch::app::recorder {

/// State of the process that was reported with a frame set. Times are nanoseconds of UTC since
/// 1970.
struct RecordedState {
  std::uint64_t utc = 0;       ///< stamp of the frame set
  std::uint64_t computed = 0;  ///< when it was measured; if not known, its stamp
  ProcessState state;
};

/// The states of the process in a recording of any origin, in the order of the file. Stamps may go
/// backwards, such as when another camera paces the frame sets. Thread-bound.
class RecordedStates {
 public:
  /// Errors: those of hal::mcap::Reader.
  static Result<RecordedStates> open(const std::filesystem::path& file);

  /// The next state; nullopt behind the last one. Error: damaged.
  Result<std::optional<RecordedState>> next();

  /// States so far.
  std::size_t count() const { return count_; }
  const std::filesystem::path& file() const { return file_; }
  /// The recording, for what is not in its chunks.
  hal::mcap::Reader& reader() { return reader_; }

 private:
  RecordedStates(std::filesystem::path file, hal::mcap::Reader reader)
      : file_(std::move(file)), reader_(std::move(reader)) {}

  Result<RecordedState> state_in(const hal::mcap::Message& message, const std::string& topic);

  std::filesystem::path file_;
  hal::mcap::Reader reader_;
  std::size_t next_chunk_ = 0;
  std::size_t count_ = 0;
};

}  // namespace orbwatch::app::recorder
