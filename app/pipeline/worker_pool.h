#pragma once

#include <atomic>
#include <condition_variable>
#include <cstddef>
#include <mutex>
#include <vector>

#include "hal/thread/thread.h"

namespace orbwatch::app {

/// Threads that share the bands of one picture with the caller. Thread-bound: one caller.
class WorkerPool {
 public:
  /// `threads` besides the caller's own; 0 makes run() a plain loop.
  explicit WorkerPool(std::size_t threads);

  /// Calls work(band) for every band in [0, bands), each once, and returns when all are done. The
  /// work must not throw. Does not allocate.
  template <class Work>
  void run(int bands, Work& work) {
    run_bands(
        bands, [](void* context, int band) { (*static_cast<Work*>(context))(band); }, &work);
  }

 private:
  using Call = void (*)(void*, int);

  void run_bands(int bands, Call call, void* context);
  void serve(hal::Thread& thread);
  void call_bands();

  // Written by the caller while no worker is busy.
  Call call_ = nullptr;
  void* context_ = nullptr;
  int bands_ = 0;
  std::atomic<int> next_{0};  ///< band that nobody has begun
  std::mutex mutex_;
  std::condition_variable done_;
  std::size_t busy_ = 0;  ///< workers that share the current run
  std::vector<hal::Thread> threads_;
};

}  // namespace orbwatch::app
