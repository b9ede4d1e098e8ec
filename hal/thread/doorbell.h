#pragma once

#include <atomic>

namespace orbwatch::hal {

/// Wakes a thread that waits for work. A ring while nobody waits is kept; several are kept as one.
/// Thread rule: ring by any thread, it waits for nothing; wait by one thread.
class Doorbell {
 public:
  void ring() {
    rings_.fetch_add(1, std::memory_order_release);
    rings_.notify_one();
  }

  /// Returns when it was rung since the last wait.
  void wait() {
    rings_.wait(heard_, std::memory_order_acquire);
    heard_ = rings_.load(std::memory_order_acquire);
  }

 private:
  std::atomic<int> rings_{0};  // an int is what the kernel waits for without a lock
  int heard_ = 0;              // the waiting thread's
};

}  // namespace orbwatch::hal
