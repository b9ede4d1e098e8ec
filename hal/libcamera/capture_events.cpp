#include "hal/libcamera/capture_events.h"

#include <cassert>
#include <utility>

namespace orbwatch::hal {

void CaptureEvents::complete(std::size_t request) {
  {
    const std::lock_guard lock(mutex_);
    assert(news_.completed_count < kMaxRequests);
    news_.completed[news_.completed_count++] = static_cast<std::uint8_t>(request);
  }
  changed_.notify_one();
}

void CaptureEvents::put_back(std::size_t buffer) {
  {
    const std::lock_guard lock(mutex_);
    news_.returned |= 1U << buffer;
  }
  changed_.notify_one();
}

void CaptureEvents::remove_camera() {
  {
    const std::lock_guard lock(mutex_);
    news_.removed = true;
  }
  changed_.notify_one();
}

void CaptureEvents::ring() {
  {
    const std::lock_guard lock(mutex_);
    news_.rung = true;
  }
  changed_.notify_one();
}

CaptureEvents::News CaptureEvents::wait(TimePoint deadline) {
  std::unique_lock lock(mutex_);
  changed_.wait_until(lock, deadline, [this] {
    return news_.completed_count != 0 || news_.returned != 0 || news_.removed || news_.rung;
  });
  return std::exchange(news_, {});
}

}  // namespace orbwatch::hal
