#include "app/pipeline/worker_pool.h"

#include <algorithm>
#include <string>

namespace orbwatch::app {

WorkerPool::WorkerPool(std::size_t threads) : threads_(threads) {
  for (std::size_t i = 0; i < threads; ++i) {
    hal::Thread& thread = threads_[i];
    thread.start("worker " + std::to_string(i + 1), [this, &thread] { serve(thread); });
  }
}

void WorkerPool::run_bands(int bands, Call call, void* context) {
  call_ = call;
  context_ = context;
  bands_ = bands;
  next_ = 0;
  const auto helpers = std::min(threads_.size(), static_cast<std::size_t>(std::max(bands - 1, 0)));
  busy_ = helpers;
  for (std::size_t i = 0; i < helpers; ++i) threads_[i].wake();
  call_bands();
  std::unique_lock lock(mutex_);
  done_.wait(lock, [this] { return busy_ == 0; });
}

void WorkerPool::serve(hal::Thread& thread) {
  while (thread.wait()) {
    call_bands();
    const std::lock_guard lock(mutex_);
    if (--busy_ == 0) done_.notify_one();
  }
}

void WorkerPool::call_bands() {
  for (int band = next_++; band < bands_; band = next_++) call_(context_, band);
}

}  // namespace orbwatch::app
