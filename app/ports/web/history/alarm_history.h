#pragma once

#include <atomic>
#include <chrono>
#include <cstddef>
#include <cstdint>
#include <mutex>
#include <vector>

#include "app/model/alarm_notice.h"
#include "hal/thread/priority_mutex.h"

namespace orbwatch::app::web {

/// What happened to alarms, the newest events. Has its memory from the beginning. Thread-safe;
/// accept() waits for a copy of them at most.
class AlarmHistory {
 public:
  static constexpr std::size_t kMost = 500;

  struct Entry {
    AlarmNotice notice;
    std::chrono::system_clock::time_point time;  ///< UTC
  };

  AlarmHistory() : ring_(kMost) {}

  /// For the pipeline's thread: allocates nothing.
  void accept(const AlarmNotice& notice);

  /// At most so many, oldest first.
  std::vector<Entry> newest(std::size_t most) const;

  /// Since the start, also those that are forgotten.
  std::uint64_t count() const { return count_; }

 private:
  mutable hal::PriorityMutex mutex_;
  std::vector<Entry> ring_;  ///< under mutex_; number n at n % kMost, from 0
  std::atomic<std::uint64_t> count_{0};
};

}  // namespace orbwatch::app::web
