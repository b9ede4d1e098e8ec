// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <atomic>
#include <chrono>
#include <condition_variable>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <memory>
#include <mutex>
#include <string_view>
#include <vector>

#include "hal/clock.h"
#include "hal/thread/priority_mutex.h"
#include "hal/thread/thread.h"

namespace orbwatch::hal {

/// A few threads for many kinds of work that may wait for each other: pictures to encode, views to
/// compile. The earliest request is served first; each work runs on one thread at a time. Works
/// keep their threads alive. Thread-safe.
class SharedThreads {
 public:
  class Work {
   public:
    /// `body` must not throw; it runs on one of the threads.
    Work(std::shared_ptr<SharedThreads> threads, std::function<void()> body);
    Work(const Work&) = delete;
    Work& operator=(const Work&) = delete;
    ~Work();

    /// Requests one call of the body, soon after `due`; several requests before it begins are
    /// combined, with the earliest moment. Does not wait for work. On any thread, including the
    /// body's.
    void request(TimePoint due = Clock::now());

    /// Cancels a request and waits for the end of a running call. Must not be called by the body.
    void cancel();

    /// Processor time of the calls that have ended.
    std::chrono::nanoseconds cpu_time() const { return std::chrono::nanoseconds(spent_); }

   private:
    friend SharedThreads;

    const std::shared_ptr<SharedThreads> threads_;
    const std::function<void()> body_;
    TimePoint due_ = TimePoint::max();  ///< max(): not requested; guarded by the threads' mutex_
    bool runs_ = false;                 ///< guarded by the threads' mutex_
    bool is_cancelled_ = false;         ///< requests are ignored; guarded by the threads' mutex_
    std::atomic<std::int64_t> spent_{0};
  };

  /// `name` and `role` of each; `count` is above 0.
  SharedThreads(std::string_view name, ThreadRole role, std::size_t count);
  SharedThreads(const SharedThreads&) = delete;
  SharedThreads& operator=(const SharedThreads&) = delete;

  /// Largest number of works that run at the same time.
  std::size_t count() const { return threads_.size(); }

  /// Makes threads of its own for each caller, for objects used on their own.
  static std::shared_ptr<SharedThreads> alone(std::string_view name = kBackgroundName) {
    return std::make_shared<SharedThreads>(name, ThreadRole::Background, 1);
  }
  static constexpr std::string_view kBackgroundName = "background";

 private:
  void serve(Thread& thread);
  Work* next();
  void do_one(Work& work, std::unique_lock<PriorityMutex>& lock);

  PriorityMutex mutex_;  ///< never held across work
  std::condition_variable_any changed_;
  std::condition_variable_any ended_;
  std::vector<Work*> works_;
  std::vector<Thread> threads_;
};

}  // namespace orbwatch::hal
