// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <atomic>
#include <chrono>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "hal/thread/thread.h"

namespace orbwatch::app::pipeline {

/// Threads that share the bands of one picture with the caller. A band belongs to the thread that
/// claims it first, and run() waits for claimed bands only: a worker that the kernel did not
/// schedule in time delays no other thread. Thread-bound: one caller.
class WorkerPool {
 public:
  /// `threads` do not include the caller's own; 0 makes run() a plain loop.
  explicit WorkerPool(std::size_t threads);

  /// Calls work(band) for every band in [0, bands), each once, in any order, and returns when all
  /// are done. `bands`: at most kMaxBands. The work must not throw. Does not allocate.
  template <class Work>
  void run(int bands, Work& work) {
    run_bands(
        bands, [](void* context, int band) { (*static_cast<Work*>(context))(band); }, &work);
  }

  static constexpr int kBandBits = 20;
  static constexpr int kMaxBands = (1 << kBandBits) - 1;

  /// Returns the processor time of the workers, without the caller's, for the runs since the last
  /// call.
  std::chrono::nanoseconds take_spent();

 private:
  using Call = void (*)(void*, int);

  void run_bands(int bands, Call call, void* context);
  int claim();
  int work_on(int band);
  void serve(hal::Thread& thread);

  // Written by the caller while no band is claimed, read by the threads that claimed one.
  Call call_ = nullptr;
  void* context_ = nullptr;
  /// Number of the run, its bands, and the next unclaimed one: one word, so that a band can be
  /// claimed only in the run in which it was read.
  std::atomic<std::uint64_t> claims_{0};
  std::atomic<int> unfinished_{0};  ///< number of bands; the kernel waits for an int without a lock
  std::atomic<std::int64_t> spent_{0};  ///< ns
  std::vector<hal::Thread> threads_;
};

}  // namespace orbwatch::app::pipeline
