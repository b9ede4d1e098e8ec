#include "hal/libcamera/capture_events.h"

#include <cassert>
#include <utility>

namespace orbwatch::hal {

void CaptureEvents::complete(std::size_t request) {
  {
    const std::lock_guard lock(mutex_);
    assert(pending_.completed_count < kMaxRequests);
    pending_.completed[pending_.completed_count++] = static_cast<std::uint8_t>(request);
  }
  changed_.notify_one();
}

void CaptureEvents::return_buffer(std::size_t buffer) {
  {
    const std::lock_guard lock(mutex_);
    pending_.returned |= 1U << buffer;
  }
  changed_.notify_one();
}

void CaptureEvents::remove_camera() {
  {
    const std::lock_guard lock(mutex_);
    pending_.removed = true;
  }
  changed_.notify_one();
}

void CaptureEvents::wake() {
  {
    const std::lock_guard lock(mutex_);
    pending_.woken = true;
  }
  changed_.notify_one();
}

CaptureEvents::Pending CaptureEvents::wait(TimePoint deadline) {
  std::unique_lock lock(mutex_);
  changed_.wait_until(lock, deadline, [this] {
    return pending_.completed_count != 0 || pending_.returned != 0 || pending_.removed ||
           pending_.woken;
  });
  return std::exchange(pending_, {});
}

}  // namespace orbwatch::hal
