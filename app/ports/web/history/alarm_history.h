// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <atomic>
#include <chrono>
#include <cstddef>
#include <cstdint>
#include <mutex>
#include <vector>

#include "app/model/status/alarm_notice.h"
#include "hal/thread/priority_mutex.h"

namespace orbwatch::app::web {

/// The newest events of alarms. Memory is allocated at construction. Thread-safe; accept() waits at
/// most for a copy of the events.
class AlarmHistory {
 public:
  static constexpr std::size_t kMost = 500;

  struct Entry {
    AlarmNotice notice;
    std::chrono::system_clock::time_point time;  ///< UTC
  };

  AlarmHistory() : ring_(kMost) {}

  /// Adds an event; for the pipeline's thread, allocates nothing.
  void accept(const AlarmNotice& notice);

  /// The newest events, at most `most`, oldest first.
  std::vector<Entry> newest(std::size_t most) const;

  /// Number of events since the start, including dropped ones.
  std::uint64_t count() const { return count_; }

 private:
  mutable hal::PriorityMutex mutex_;
  std::vector<Entry> ring_;  ///< guarded by mutex_; number n at n % kMost, from 0
  std::atomic<std::uint64_t> count_{0};
};

}  // namespace orbwatch::app::web
