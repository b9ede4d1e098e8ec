// SPDX-License-Identifier: Apache-2.0
#include "hal/lines/watchdog_output.h"

#include <algorithm>
#include <utility>

namespace orbwatch::hal {

WatchdogOutput::WatchdogOutput(const WatchdogSettings& settings,
                               std::unique_ptr<DigitalOutput> output, std::function<void()> wake)
    : settings_(settings), wake_(std::move(wake)), output_(std::move(output)) {}

void WatchdogOutput::report(bool healthy, TimePoint now) {
  bool changed = false;
  {
    const std::lock_guard lock(mutex_);
    healthy_ = healthy;
    if (healthy) last_ = now;
    changed = healthy != is_up_;
  }
  if (changed) wake_();
}

TimePoint WatchdogOutput::due() const {
  const std::lock_guard lock(mutex_);
  if (healthy_ != is_up_) return TimePoint::min();
  if (!is_up_) return TimePoint::max();
  const TimePoint silent = last_ + settings_.timeout + Clock::duration(1);
  return std::min(silent, next_toggle_);
}

void WatchdogOutput::run(TimePoint now) {
  const bool level = next_level(now);
  if (level == std::exchange(active_, level)) return;
  failed_ += output_->set(level) ? 0 : 1;  // without the lock, so that report() does not wait
}

bool WatchdogOutput::next_level(TimePoint now) {
  const std::lock_guard lock(mutex_);
  if (!healthy_ || now > last_ + settings_.timeout) {
    healthy_ = is_up_ = false;
    return false;
  }
  if (is_up_ && now < next_toggle_) return active_;
  const bool toggles = settings_.half_period.count() > 0;
  next_toggle_ = toggles ? now + settings_.half_period : TimePoint::max();
  return std::exchange(is_up_, true) ? !active_ : true;
}

}  // namespace orbwatch::hal
