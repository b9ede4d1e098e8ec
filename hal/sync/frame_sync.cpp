// SPDX-License-Identifier: Apache-2.0
#include "hal/sync/frame_sync.h"

#include <algorithm>
#include <utility>

namespace orbwatch::hal {

void FrameSync::put(std::size_t camera, Frame frame) {
  ReleasedFrames released;  // destroyed after the lock
  {
    const std::lock_guard lock(mutex_);
    matcher_.put(camera, std::move(frame), Clock::now(), released);
  }
  changed_.notify_one();
}

void FrameSync::clear(std::size_t camera) {
  ReleasedFrames released;
  {
    const std::lock_guard lock(mutex_);
    matcher_.clear(camera, released);
  }
  changed_.notify_one();
}

std::optional<FrameSet> FrameSync::next(TimePoint until) {
  ReleasedFrames released;  // destroyed after the lock
  std::unique_lock lock(mutex_);
  while (!closed_) {
    if (auto set = matcher_.take(Clock::now(), released)) return set;
    if (!released.is_empty()) {
      lock.unlock();
      released.clear();
      lock.lock();
      continue;
    }
    const TimePoint wake = std::min(until, matcher_.wake(Clock::now()));
    if (changed_.wait_until(lock, wake) == std::cv_status::timeout && Clock::now() >= until) {
      return std::nullopt;
    }
  }
  return std::nullopt;
}

bool FrameSync::has_set() const {
  const std::lock_guard lock(mutex_);
  return matcher_.has_set(Clock::now());
}

void FrameSync::close() {
  {
    const std::lock_guard lock(mutex_);
    closed_ = true;
  }
  changed_.notify_all();
}

bool FrameSync::is_late(std::size_t camera) const {
  const std::lock_guard lock(mutex_);
  return matcher_.is_late(camera, Clock::now());
}

FrameCounts FrameSync::counts(std::size_t camera) const {
  const std::lock_guard lock(mutex_);
  return matcher_.counts(camera);
}

}  // namespace orbwatch::hal
