#include "app/health/health_sampler.h"

#include <algorithm>

namespace orbwatch::app {

void HealthSampler::start() {
  if (!thread_.is_running()) thread_.start("health", [this] { run(); });
}

Health HealthSampler::latest(hal::TimePoint now) const {
  const std::lock_guard lock(mutex_);
  return now - read_at_ <= kLongestAge ? health_ : Health{};
}

void HealthSampler::run() {
  auto due = hal::Clock::now();
  do {
    const auto began = hal::Clock::now();
    const Health health = read_();
    {
      const std::lock_guard lock(mutex_);
      health_ = health;
      read_at_ = began;
    }
    due = std::max(due + period_, began);  // a missed period is skipped
  } while (thread_.wait_until(due));
}

}  // namespace orbwatch::app
