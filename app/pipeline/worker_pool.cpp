#include "app/pipeline/worker_pool.h"

namespace orbwatch::app {

WorkerPool::WorkerPool(std::size_t threads) {
  threads_.reserve(threads);
  for (std::size_t i = 0; i < threads; ++i) threads_.emplace_back([this] { serve(); });
}

WorkerPool::~WorkerPool() {
  {
    const std::lock_guard lock(mutex_);
    stopping_ = true;
  }
  work_.notify_all();
  for (auto& thread : threads_) thread.join();
}

void WorkerPool::run_bands(int bands, Call call, void* context) {
  {
    const std::lock_guard lock(mutex_);
    call_ = call;
    context_ = context;
    bands_ = bands;
    next_ = 0;
    busy_ = threads_.size();
    ++round_;
  }
  work_.notify_all();
  take_bands(call, context, bands);
  std::unique_lock lock(mutex_);
  done_.wait(lock, [this] { return busy_ == 0; });
}

void WorkerPool::serve() {
  std::uint64_t seen = 0;
  std::unique_lock lock(mutex_);
  while (true) {
    work_.wait(lock, [&] { return stopping_ || round_ != seen; });
    if (stopping_) return;
    seen = round_;
    const Call call = call_;
    void* const context = context_;
    const int bands = bands_;
    lock.unlock();
    take_bands(call, context, bands);
    lock.lock();
    if (--busy_ == 0) done_.notify_one();
  }
}

void WorkerPool::take_bands(Call call, void* context, int bands) {
  for (int band = next_++; band < bands; band = next_++) call(context, band);
}

}  // namespace orbwatch::app
