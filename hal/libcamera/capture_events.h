#pragma once

#include <array>
#include <condition_variable>
#include <cstddef>
#include <cstdint>
#include <mutex>

#include "hal/clock.h"

namespace orbwatch::hal {

/// Events for the camera's thread from libcamera's thread and from those that release frames.
/// Outlives the stream for as long as frames are held. Holds one entry per request, so it cannot
/// overflow. Thread-safe with one waiter; senders never wait for it.
class CaptureEvents {
 public:
  static constexpr std::size_t kMaxRequests = 32;

  /// Events since the last wait().
  struct Pending {
    std::array<std::uint8_t, kMaxRequests> completed{};  ///< request numbers, oldest first
    std::size_t completed_count = 0;
    std::uint32_t returned = 0;  ///< one bit per buffer whose last frame was released
    bool removed = false;        ///< the camera was unplugged
    bool woken = false;
  };

  /// A request was completed; each is queued at most once.
  void complete(std::size_t request);
  void return_buffer(std::size_t buffer);
  void remove_camera();
  /// Ends a wait.
  void wake();

  /// Waits for events until `deadline` and takes them.
  Pending wait(TimePoint deadline);

 private:
  std::mutex mutex_;
  std::condition_variable changed_;
  Pending pending_;
};

}  // namespace orbwatch::hal
