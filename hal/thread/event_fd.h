#pragma once

#include <sys/eventfd.h>

#include <algorithm>
#include <chrono>

#include "hal/clock.h"
#include "hal/thread/file_descriptor.h"

namespace orbwatch::hal {

/// Wakes a thread that waits on files: an eventfd, readable from signal() to clear().
/// Thread rule: signal on any thread, it waits for nothing; clear on the thread that waits.
class EventFd {
 public:
  /// Not open when the process may have no more files.
  EventFd() : file_(::eventfd(0, EFD_NONBLOCK | EFD_CLOEXEC)) {}

  bool is_open() const { return file_.is_open(); }
  int get() const { return file_.get(); }

  /// Fails only when 2^64 - 1 signals were not cleared, which are as good as one.
  void signal() const { static_cast<void>(::eventfd_write(get(), 1)); }

  /// Fails only when there was no signal.
  void clear() const {
    eventfd_t signals = 0;
    static_cast<void>(::eventfd_read(get(), &signals));
  }

 private:
  FileDescriptor file_;
};

/// The timeout for poll() and epoll_wait() that ends at or after `deadline`, or in a minute:
/// callers wait again until their deadline has passed.
inline int poll_timeout(TimePoint deadline) {
  using std::chrono::milliseconds;
  const auto now = Clock::now();
  if (deadline <= now) return 0;
  const auto left = std::min<Clock::duration>(deadline - now, std::chrono::minutes(1));
  return static_cast<int>(std::chrono::ceil<milliseconds>(left).count());
}

}  // namespace orbwatch::hal
