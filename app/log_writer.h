// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <chrono>
#include <condition_variable>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <initializer_list>
#include <mutex>
#include <string>
#include <string_view>

#include "app/log.h"
#include "hal/thread/priority_mutex.h"
#include "hal/thread/thread.h"

namespace orbwatch::app {

/// Writes the log of the process during its lifetime, on a thread of its own and in order.
/// log_line() returns when its line is written, as long as a reader reads the log: a stalled
/// reader, such as a pipe or the journal, delays one line by kLongestWait, and no further line
/// until it reads again. Made before the threads that log, and outlives them.
class LogWriter {
 public:
  /// May wait and allocate; there are no concurrent calls.
  using Output = std::function<void(const LogRecord&)>;

  /// Limit for lines that wait for the reader; further ones are dropped and counted.
  static constexpr std::size_t kMaxWaiting = 64;
  /// Bytes of a line from the frame path; the rest is cut.
  static constexpr std::size_t kMaxText = 512;
  /// Longest wait of log_line() for a reader that does not read.
  static constexpr std::chrono::seconds kLongestWait{1};

  explicit LogWriter(Output output);
  LogWriter(const LogWriter&) = delete;
  LogWriter& operator=(const LogWriter&) = delete;
  /// Writes the waiting lines; waits for the reader without a limit.
  ~LogWriter();

  /// The existing writer, or null.
  static LogWriter* current();

  void write(const LogRecord& record);
  void write_soon(LogLevel level, std::initializer_list<std::string_view> text,
                  const LogFields& fields);

  /// Returns when all lines logged before are written. False: `patience` has passed.
  bool flush(std::chrono::milliseconds patience = std::chrono::hours(1));

 private:
  template <std::size_t kMost>
  class Text {
   public:
    void append(std::string_view part);
    std::string_view view() const { return {bytes_.data(), size_}; }

   private:
    std::array<char, kMost> bytes_{};
    std::size_t size_ = 0;
  };

  struct Waiting {
    LogLevel level = LogLevel::Info;
    Text<kMaxText> text{};
    std::string rest{};  ///< rest of a line beyond kMaxText, set by log_line()
    Text<64> camera{};
    Text<32> fault{};
    std::uint64_t trigger = 0;
  };

  Waiting* add(LogLevel level, std::initializer_list<std::string_view> text,
               const LogFields& fields);
  void write_waiting();
  bool write_next();

  const Output output_;
  hal::PriorityMutex queue_;                  ///< held for a copy, never while output_ is called
  std::condition_variable_any progress_;      ///< a line was written
  std::array<Waiting, kMaxWaiting> waiting_;  ///< a ring; guarded by queue_, like all members below
  std::size_t oldest_ = 0;
  std::size_t count_ = 0;
  std::uint64_t added_ = 0;    ///< lines since the start
  std::uint64_t written_ = 0;  ///< lines written of these
  std::uint64_t dropped_ = 0;
  bool is_writing_ = false;
  bool is_stalled_ = false;  ///< a wait timed out since a line was written
  hal::Thread thread_;
};

}  // namespace orbwatch::app
