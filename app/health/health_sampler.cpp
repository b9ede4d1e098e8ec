// SPDX-License-Identifier: Apache-2.0
#include "app/health/health_sampler.h"

#include <algorithm>

namespace orbwatch::app {

void HealthSampler::start() {
  if (std::exchange(is_running_, true)) return;
  due_ = hal::Clock::now();
  work_.request(due_);
}

void HealthSampler::stop() {
  is_running_ = false;
  work_.cancel();
}

Health HealthSampler::latest(hal::TimePoint now) const {
  const std::lock_guard lock(mutex_);
  return now - read_at_ <= kLongestAge ? health_ : Health{};
}

void HealthSampler::sample() {
  const auto began = hal::Clock::now();
  const Health health = read_();
  {
    const std::lock_guard lock(mutex_);
    health_ = health;
    read_at_ = began;
  }
  due_ = std::max(due_ + period_, began);  // a missed period is skipped
  work_.request(due_);
}

}  // namespace orbwatch::app
