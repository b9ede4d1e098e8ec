#include "hal/thread/thread.h"

#include <pthread.h>

#include <string>
#include <utility>

namespace orbwatch::hal {

void Thread::start(std::string_view name, std::function<void()> body) {
  stop();
  stop_ = std::stop_source();
  thread_ =
      std::thread([this, name = std::string(name.substr(0, kMaxName)), body = std::move(body)] {
        runner_ = std::this_thread::get_id();
        ::pthread_setname_np(::pthread_self(), name.c_str());
        body();
      });
}

void Thread::stop() {
  stop_.request_stop();
  if (std::this_thread::get_id() == runner_.load() || !thread_.joinable()) return;
  thread_.join();
  runner_ = std::thread::id();  // the system may reuse it for another thread
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
