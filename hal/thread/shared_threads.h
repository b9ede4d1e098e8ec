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
#include "hal/thread/thread.h"

namespace orbwatch::hal {

/// A few threads for many kinds of work that may wait for each other: pictures to encode, views to
/// compile. What was requested first is done first; each work is done by one thread at a time.
/// Works keep their threads alive. Thread-safe.
class SharedThreads {
 public:
  class Work {
   public:
    /// `body` must not throw; it runs on one of the threads.
    Work(std::shared_ptr<SharedThreads> threads, std::function<void()> body);
    Work(const Work&) = delete;
    Work& operator=(const Work&) = delete;
    ~Work();

    /// Has the body called once, soon after `due`; several requests before it begins are one, by
    /// the earliest. Waits for no work. On any thread, the body included.
    void request(TimePoint due = Clock::now());

    /// Forgets a request and waits for the end of a call under way. Not in the body.
    void cancel();

    /// Processor time of the calls that have ended.
    std::chrono::nanoseconds cpu_time() const { return std::chrono::nanoseconds(spent_); }

   private:
    friend SharedThreads;

    const std::shared_ptr<SharedThreads> threads_;
    const std::function<void()> body_;
    TimePoint due_ = TimePoint::max();  ///< max(): not requested; under the threads' mutex_
    bool runs_ = false;                 ///< under the threads' mutex_
    bool is_cancelled_ = false;         ///< requests are ignored; under the threads' mutex_
    std::atomic<std::int64_t> spent_{0};
  };

  /// `name` and `role` of each; `count` is above 0.
  SharedThreads(std::string_view name, ThreadRole role, std::size_t count);
  SharedThreads(const SharedThreads&) = delete;
  SharedThreads& operator=(const SharedThreads&) = delete;

  /// How many works are done at a time at most.
  std::size_t count() const { return threads_.size(); }

  /// One of its own for each caller: for objects that stand alone.
  static std::shared_ptr<SharedThreads> alone(std::string_view name = kBackgroundName) {
    return std::make_shared<SharedThreads>(name, ThreadRole::Background, 1);
  }
  static constexpr std::string_view kBackgroundName = "background";

 private:
  void serve(Thread& thread);
  Work* next();
  void do_one(Work& work, std::unique_lock<std::mutex>& lock);

  std::mutex mutex_;  ///< never held across work
  std::condition_variable_any changed_;
  std::condition_variable ended_;
  std::vector<Work*> works_;
  std::vector<Thread> threads_;
};

}  // namespace orbwatch::hal
