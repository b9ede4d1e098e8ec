// SPDX-License-Identifier: Apache-2.0
#include "hal/thread/shared_threads.h"

#include <algorithm>
#include <utility>

#include "hal/thread/cpu_time.h"

namespace orbwatch::hal {

SharedThreads::Work::Work(std::shared_ptr<SharedThreads> threads, std::function<void()> body)
    : threads_(std::move(threads)), body_(std::move(body)) {
  const std::lock_guard lock(threads_->mutex_);
  threads_->works_.push_back(this);
}

SharedThreads::Work::~Work() {
  cancel();
  const std::lock_guard lock(threads_->mutex_);
  std::erase(threads_->works_, this);
}

void SharedThreads::Work::request(TimePoint due) {
  {
    const std::lock_guard lock(threads_->mutex_);
    if (!is_cancelled_) due_ = std::min(due_, due);
  }
  threads_->changed_.notify_one();
}

void SharedThreads::Work::cancel() {
  std::unique_lock lock(threads_->mutex_);
  due_ = TimePoint::max();
  is_cancelled_ = true;  // the running call may request another
  threads_->ended_.wait(lock, [this] { return !runs_; });
  is_cancelled_ = false;
}

SharedThreads::SharedThreads(std::string_view name, ThreadRole role, std::size_t count)
    : threads_(count) {
  for (Thread& thread : threads_) thread.start(name, role, [this, &thread] { serve(thread); });
}

void SharedThreads::serve(Thread& thread) {
  std::unique_lock lock(mutex_);
  while (!thread.stop_requested()) {
    Work* const work = next();
    const TimePoint due = work ? work->due_ : TimePoint::max();
    if (due <= Clock::now()) {
      do_one(*work, lock);
    } else {
      changed_.wait_until(lock, thread.stop_token(), due, [this, due] {
        const Work* const sooner = next();
        return sooner && sooner->due_ < due;
      });
    }
  }
}

/// The requested work that is due first and does not run yet; null: none.
SharedThreads::Work* SharedThreads::next() {
  Work* first = nullptr;
  for (Work* work : works_) {
    if (work->runs_ || work->due_ == TimePoint::max()) continue;
    if (!first || work->due_ < first->due_) first = work;
  }
  return first;
}

void SharedThreads::do_one(Work& work, std::unique_lock<PriorityMutex>& lock) {
  work.due_ = TimePoint::max();
  work.runs_ = true;
  lock.unlock();
  const auto begin = cpu_time_of_this_thread();
  work.body_();
  work.spent_ += (cpu_time_of_this_thread() - begin).count();
  lock.lock();
  work.runs_ = false;
  ended_.notify_all();
}

}  // namespace orbwatch::hal
