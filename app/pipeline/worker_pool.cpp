// SPDX-License-Identifier: Apache-2.0
#include "app/pipeline/worker_pool.h"

#include <algorithm>
#include <cassert>
#include <string>

#include "hal/thread/cpu_time.h"

namespace orbwatch::app::pipeline {

namespace {

static_assert(std::atomic<std::uint64_t>::is_always_lock_free);

constexpr std::uint64_t kBandMask = WorkerPool::kMaxBands;

constexpr std::uint64_t next_of(std::uint64_t claims) { return claims & kBandMask; }
constexpr std::uint64_t bands_of(std::uint64_t claims) {
  return claims >> WorkerPool::kBandBits & kBandMask;
}
constexpr std::uint64_t run_of(std::uint64_t claims) { return claims >> 2 * WorkerPool::kBandBits; }

constexpr std::uint64_t unclaimed(std::uint64_t run, int bands) {
  return run << 2 * WorkerPool::kBandBits | static_cast<std::uint64_t>(bands)
                                                << WorkerPool::kBandBits;
}

}  // namespace

WorkerPool::WorkerPool(std::size_t threads) : threads_(threads) {
  for (std::size_t i = 0; i < threads; ++i) {
    hal::Thread& thread = threads_[i];
    thread.start("worker " + std::to_string(i + 1), hal::ThreadRole::Worker,
                 [this, &thread] { serve(thread); });
  }
}

void WorkerPool::run_bands(int bands, Call call, void* context) {
  assert(bands <= kMaxBands);
  if (bands <= 0) return;
  call_ = call;
  context_ = context;
  unfinished_ = bands;
  const std::uint64_t run = run_of(claims_.load(std::memory_order_relaxed)) + 1;
  claims_.store(unclaimed(run, bands), std::memory_order_release);
  const auto helpers = std::min(threads_.size(), static_cast<std::size_t>(bands - 1));
  for (std::size_t i = 0; i < helpers; ++i) threads_[i].wake();
  int left = unfinished_ -= work_on(claim());
  for (; left > 0; left = unfinished_) unfinished_.wait(left);
}

/// Claims a band for the caller; -1: none is left.
int WorkerPool::claim() {
  std::uint64_t seen = claims_.load(std::memory_order_acquire);
  while (next_of(seen) < bands_of(seen)) {
    if (claims_.compare_exchange_weak(seen, seen + 1, std::memory_order_acq_rel,
                                      std::memory_order_acquire)) {
      return static_cast<int>(next_of(seen));
    }
  }
  return -1;
}

/// Does the claimed `band`, if any, and those that can be claimed after it. Returns their number;
/// the run cannot end before it is subtracted from unfinished_.
int WorkerPool::work_on(int band) {
  int done = 0;
  for (; band >= 0; band = claim()) {
    call_(context_, band);
    ++done;
  }
  return done;
}

void WorkerPool::serve(hal::Thread& thread) {
  auto counted = hal::cpu_time_of_this_thread();
  while (thread.wait()) {
    const int band = claim();
    if (band < 0) continue;
    const int done = work_on(band);
    // This includes the time to wake up, also when no band was left.
    const auto now = hal::cpu_time_of_this_thread();
    spent_ += (now - counted).count();
    counted = now;
    if ((unfinished_ -= done) == 0) unfinished_.notify_one();
  }
}

std::chrono::nanoseconds WorkerPool::take_spent() {
  return std::chrono::nanoseconds(spent_.exchange(0));
}

}  // namespace orbwatch::app::pipeline
