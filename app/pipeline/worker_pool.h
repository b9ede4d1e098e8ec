#pragma once

#include <atomic>
#include <condition_variable>
#include <cstdint>
#include <mutex>
#include <thread>
#include <vector>

namespace orbwatch::app {

/// Threads that share the bands of one picture with the caller. Thread-bound: one caller.
class WorkerPool {
 public:
  /// `threads` besides the caller's own; 0 makes run() a plain loop.
  explicit WorkerPool(std::size_t threads);
  ~WorkerPool();
  WorkerPool(const WorkerPool&) = delete;
  WorkerPool& operator=(const WorkerPool&) = delete;

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
  void serve();
  void take_bands(Call call, void* context, int bands);

  std::mutex mutex_;
  std::condition_variable work_;
  std::condition_variable done_;
  std::uint64_t round_ = 0;
  std::size_t busy_ = 0;
  bool stopping_ = false;
  Call call_ = nullptr;
  void* context_ = nullptr;
  int bands_ = 0;
  std::atomic<int> next_{0};
  std::vector<std::thread> threads_;
};

}  // namespace orbwatch::app
