// SPDX-License-Identifier: Apache-2.0
#include "hal/thread/thread.h"

#include <pthread.h>

#include <string>
#include <utility>

#include "hal/thread/cpu_time.h"

namespace orbwatch::hal {

void Thread::start(std::string_view name, ThreadRole role, std::function<void()> body) {
  stop();
  stop_ = std::stop_source();
  thread_ = std::thread(
      [this, name = std::string(name.substr(0, kMaxName)), role, body = std::move(body)] {
        runner_ = std::this_thread::get_id();
        ::pthread_setname_np(::pthread_self(), name.c_str());
        schedule_this_thread(role);
        clockid_t clock = kNoClock;
        if (::pthread_getcpuclockid(::pthread_self(), &clock) == 0) clock_ = clock;
        body();
        clock_ = kNoClock;
        spent_ += cpu_time_of_this_thread().count();
      });
}

void Thread::stop() {
  stop_.request_stop();
  if (std::this_thread::get_id() == runner_.load() || !thread_.joinable()) return;
  thread_.join();
  runner_ = std::thread::id();  // the system may reuse it for another thread
}

std::chrono::nanoseconds Thread::cpu_time() const {
  const clockid_t clock = clock_;
  const std::chrono::nanoseconds ended(spent_);
  return clock == kNoClock ? ended : ended + hal::cpu_time(clock);
}

void Thread::wake() {
  {
    const std::lock_guard lock(mutex_);
    woken_ = true;
  }
  changed_.notify_one();
}

bool Thread::wait() { return wait_until(TimePoint::max()); }

bool Thread::wait_until(TimePoint moment) {
  std::unique_lock lock(mutex_);
  changed_.wait_until(lock, stop_.get_token(), moment, [this] { return woken_; });
  woken_ = false;
  return !stop_.stop_requested();
}

}  // namespace orbwatch::hal
