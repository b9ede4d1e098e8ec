// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <sys/eventfd.h>
#include <unistd.h>

#include <algorithm>
#include <chrono>
#include <utility>

#include "hal/clock.h"

namespace orbwatch::hal {

/// Owns an open file of the kernel and closes it; -1: no file.
class FileDescriptor {
 public:
  explicit FileDescriptor(int number = -1) : number_(number) {}
  FileDescriptor(FileDescriptor&& other) noexcept : number_(std::exchange(other.number_, -1)) {}
  FileDescriptor& operator=(FileDescriptor&& other) noexcept {
    std::swap(number_, other.number_);
    return *this;
  }
  ~FileDescriptor() {
    if (number_ >= 0) ::close(number_);
  }

  int get() const { return number_; }
  bool is_open() const { return number_ >= 0; }

 private:
  int number_;
};

/// Wakes a thread that waits on files: an eventfd, readable from signal() to clear().
/// Thread rule: signal on any thread, without waiting; clear on the thread that waits.
class EventFd {
 public:
  /// The file is not open when the process has reached its limit of files.
  EventFd() : file_(::eventfd(0, EFD_NONBLOCK | EFD_CLOEXEC)) {}

  bool is_open() const { return file_.is_open(); }
  int get() const { return file_.get(); }

  /// This fails only when 2^64 - 1 signals were not cleared, which is equivalent to one.
  void signal() const { static_cast<void>(::eventfd_write(get(), 1)); }

  /// This fails only when there was no signal.
  void clear() const {
    eventfd_t signals = 0;
    static_cast<void>(::eventfd_read(get(), &signals));
  }

 private:
  FileDescriptor file_;
};

/// Timeout for poll() and epoll_wait() that ends at or after `deadline`, or in a minute: callers
/// wait again until their deadline has passed.
inline int poll_timeout(TimePoint deadline) {
  using std::chrono::milliseconds;
  const auto now = Clock::now();
  if (deadline <= now) return 0;
  const auto left = std::min<Clock::duration>(deadline - now, std::chrono::minutes(1));
  return static_cast<int>(std::chrono::ceil<milliseconds>(left).count());
}

}  // namespace orbwatch::hal
