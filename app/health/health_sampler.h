#pragma once

#include <chrono>
#include <condition_variable>
#include <functional>
#include <mutex>
#include <thread>

#include "app/health/health.h"
#include "hal/clock.h"

namespace orbwatch::app {

/// Reads the health on a thread of its own, so that a board or disk that answers slowly keeps
/// nobody waiting. Thread rule: start and stop on the main thread, latest on any.
class HealthSampler {
 public:
  static constexpr hal::Clock::duration kPeriod = std::chrono::seconds(1);
  /// Figures older than this say nothing about now.
  static constexpr hal::Clock::duration kLongestAge = std::chrono::seconds(5);

  /// `read` is called on the sampler's thread only, as BoardHealth::read.
  explicit HealthSampler(std::function<Health()> read, hal::Clock::duration period = kPeriod);
  ~HealthSampler();
  HealthSampler(const HealthSampler&) = delete;
  HealthSampler& operator=(const HealthSampler&) = delete;

  /// Reads for the first time at once, on its thread.
  void start();
  /// Waits for a reading that is under way.
  void stop();

  /// The newest figures; none is valid before the first reading, or when it began more than
  /// kLongestAge before `now`. The lock is held for no longer than a copy.
  Health latest(hal::TimePoint now) const;

 private:
  void run();

  const std::function<Health()> read_;
  const hal::Clock::duration period_;
  mutable std::mutex mutex_;
  std::condition_variable wake_;
  Health health_;
  hal::TimePoint read_at_;
  bool stopping_ = false;
  std::thread thread_;
};

}  // namespace orbwatch::app
