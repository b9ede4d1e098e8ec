#include "app/health/health_sampler.h"

#include <algorithm>
#include <utility>

namespace orbwatch::app {

HealthSampler::HealthSampler(std::function<Health()> read, hal::Clock::duration period)
    : read_(std::move(read)), period_(period) {}

HealthSampler::~HealthSampler() { stop(); }

void HealthSampler::start() {
  if (thread_.joinable()) return;
  stopping_ = false;
  thread_ = std::thread([this] { run(); });
}

void HealthSampler::stop() {
  if (!thread_.joinable()) return;
  {
    const std::lock_guard lock(mutex_);
    stopping_ = true;
  }
  wake_.notify_all();
  thread_.join();
}

Health HealthSampler::latest(hal::TimePoint now) const {
  const std::lock_guard lock(mutex_);
  return now - read_at_ <= kLongestAge ? health_ : Health{};
}

void HealthSampler::run() {
  for (auto due = hal::Clock::now();;) {
    const auto began = hal::Clock::now();
    const Health health = read_();
    due = std::max(due + period_, began);  // what is late is not made up for
    std::unique_lock lock(mutex_);
    health_ = health;
    read_at_ = began;
    if (wake_.wait_until(lock, due, [this] { return stopping_; })) return;
  }
}

}  // namespace orbwatch::app
