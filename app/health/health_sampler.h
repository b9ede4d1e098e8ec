// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <chrono>
#include <functional>
#include <memory>
#include <mutex>
#include <utility>

#include "app/model/status/health.h"
#include "hal/clock.h"
#include "hal/thread/priority_mutex.h"
#include "hal/thread/shared_threads.h"

namespace orbwatch::app {

/// Reads the health on a thread, so that a slow board or disk does not delay the frame path. The
/// thread should not be shared with other work: the disk of a network mount may not answer.
/// Thread rule: start and stop on the main thread, latest on any.
class HealthSampler {
 public:
  static constexpr hal::Clock::duration kPeriod = std::chrono::seconds(1);
  /// Age above which figures are invalid.
  static constexpr hal::Clock::duration kLongestAge = std::chrono::seconds(5);

  /// `read` is called on one of the `threads`, one call at a time, like BoardHealth::read.
  explicit HealthSampler(std::function<Health()> read, hal::Clock::duration period = kPeriod,
                         std::shared_ptr<hal::SharedThreads> threads = hal::SharedThreads::alone())
      : read_(std::move(read)), period_(period), work_(std::move(threads), [this] { sample(); }) {}
  /// Starts the first reading at once, on its thread. Repeating it does nothing.
  void start();
  /// Waits for a running reading.
  void stop();

  /// The newest figures; none is valid before the first reading, or when it began more than
  /// kLongestAge before `now`. The lock is held only for a copy.
  Health latest(hal::TimePoint now) const;

 private:
  void sample();

  const std::function<Health()> read_;
  const hal::Clock::duration period_;
  mutable hal::PriorityMutex mutex_;
  Health health_;
  hal::TimePoint read_at_;
  bool is_running_ = false;  ///< used by the main thread only
  hal::TimePoint due_;       ///< moment of the next reading; used by the work only
  hal::SharedThreads::Work work_;
};

}  // namespace orbwatch::app
