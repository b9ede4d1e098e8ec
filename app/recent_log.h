// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <chrono>
#include <cstddef>
#include <cstdint>
#include <deque>
#include <mutex>
#include <string>
#include <vector>

#include "app/log.h"

namespace orbwatch::app {

/// Newest lines of this process's log, for users without access to the journal. Thread-safe;
/// allocates, so never on the frame path: the LogWriter's thread calls it.
class RecentLog {
 public:
  static constexpr std::size_t kMostLines = 1000;
  /// Bytes of a line; the rest is cut.
  static constexpr std::size_t kMostText = 1024;

  struct Line {
    std::uint64_t number = 0;  ///< counted from 1
    std::chrono::system_clock::time_point time{};
    LogLevel level = LogLevel::Info;
    std::string text;
    std::string camera;
    std::string fault;
    std::uint64_t trigger = 0;
  };

  /// Selection of a reader.
  struct Wanted {
    std::size_t most = kMostLines;
    LogLevel least = LogLevel::Info;  ///< least severe level
    std::uint64_t after = 0;          ///< number of the newest line that the reader already has
  };

  void add(const LogRecord& record);
  /// Start of this process's log, from which its lines are counted.
  std::chrono::system_clock::time_point started() const { return started_; }
  /// Number of the newest line; 0: there is none yet.
  std::uint64_t newest_number() const;
  /// The newest selected lines, oldest first.
  std::vector<Line> newest(const Wanted& wanted) const;

 private:
  const std::chrono::system_clock::time_point started_ = std::chrono::system_clock::now();
  mutable std::mutex mutex_;
  std::deque<Line> lines_;    ///< guarded by mutex_
  std::uint64_t number_ = 0;  ///< number of the newest line; guarded by mutex_
};

}  // namespace orbwatch::app
