// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <atomic>
#include <cstddef>
#include <cstdint>

#include "hal/frame/buffer_count.h"
#include "hal/thread/file_descriptor.h"

namespace orbwatch::hal {

/// Buffers whose last frame was released: the camera's thread, which alone talks to the device,
/// queues them again. Outlives the stream for as long as frames are held. Thread-safe, lock-free.
class ReturnedBuffers {
 public:
  bool is_open() const { return woken_.is_open(); }
  int descriptor() const { return woken_.get(); }  ///< readable after put() or wake(), until take()
  void put(std::size_t index) {
    returned_.fetch_or(1U << index);
    wake();
  }
  void wake() { woken_.signal(); }
  /// Takes the returned buffers, one bit for each of kMaxBuffers.
  std::uint32_t take() {
    woken_.clear();
    return returned_.exchange(0);
  }

 private:
  static_assert(kMaxBuffers <= 32, "one bit each");

  EventFd woken_;
  std::atomic<std::uint32_t> returned_{0};
};

}  // namespace orbwatch::hal
