#pragma once

#include <chrono>
#include <functional>
#include <mutex>

#include "app/model/health.h"
#include "hal/clock.h"
#include "hal/thread/thread.h"

namespace orbwatch::app {

/// Reads the health on a thread of its own: a slow board or disk delays no other. Thread rule:
/// start and stop on the main thread, latest on any.
class HealthSampler {
 public:
  static constexpr hal::Clock::duration kPeriod = std::chrono::seconds(1);
  /// Older figures are invalid.
  static constexpr hal::Clock::duration kLongestAge = std::chrono::seconds(5);

  /// `read` is called on the sampler's thread only, as BoardHealth::read.
  explicit HealthSampler(std::function<Health()> read, hal::Clock::duration period = kPeriod)
      : read_(std::move(read)), period_(period) {}
  /// Reads for the first time at once, on its thread. Repeating it does nothing.
  void start();
  /// Waits for a reading that is under way.
  void stop() { thread_.stop(); }

  /// The newest figures; none is valid before the first reading, or when it began more than
  /// kLongestAge before `now`. The lock is held for no longer than a copy.
  Health latest(hal::TimePoint now) const;

 private:
  void run();

  const std::function<Health()> read_;
  const hal::Clock::duration period_;
  mutable std::mutex mutex_;
  Health health_;
  hal::TimePoint read_at_;
  hal::Thread thread_;
};

}  // namespace orbwatch::app
