#pragma once

#include <array>
#include <condition_variable>
#include <cstddef>
#include <cstdint>
#include <mutex>

#include "hal/clock.h"

namespace orbwatch::hal {

/// Where libcamera's thread and those that release frames leave word for the camera's thread. It
/// outlives the stream for as long as frames are held. Holds one entry per request, so it cannot
/// overflow. Thread-safe, one waiter; nobody who leaves word waits for it.
class CaptureEvents {
 public:
  static constexpr std::size_t kMaxRequests = 32;

  /// What happened since the last wait().
  struct News {
    std::array<std::uint8_t, kMaxRequests> completed{};  ///< request numbers, oldest first
    std::size_t completed_count = 0;
    std::uint32_t returned = 0;  ///< one bit per buffer whose last frame was released
    bool removed = false;        ///< the camera was unplugged
    bool rung = false;
  };

  /// A request came back; a request is under way at most once.
  void complete(std::size_t request);
  void put_back(std::size_t buffer);
  void remove_camera();
  /// Ends a wait, for a stop.
  void ring();

  /// Takes the news, and waits for some until `deadline`.
  News wait(TimePoint deadline);

 private:
  std::mutex mutex_;
  std::condition_variable changed_;
  News news_;
};

}  // namespace orbwatch::hal
