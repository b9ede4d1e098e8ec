// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <pthread.h>

namespace orbwatch::hal {

/// Mutex that threads of the frame path share with others: its holder runs with the priority of the
/// most urgent waiting thread (PTHREAD_PRIO_INHERIT). With a std::mutex, a holder of ordinary
/// priority that other programs preempt would block the pipeline. A BasicLockable with try_lock,
/// for std::lock_guard and std::unique_lock. On a kernel without priority inheritance it is an
/// ordinary mutex.
class PriorityMutex {
 public:
  PriorityMutex() {
    pthread_mutexattr_t attributes;
    ::pthread_mutexattr_init(&attributes);
    ::pthread_mutexattr_setprotocol(&attributes, PTHREAD_PRIO_INHERIT);
    inherits_ = ::pthread_mutex_init(&mutex_, &attributes) == 0;
    ::pthread_mutexattr_destroy(&attributes);
    if (!inherits_) ::pthread_mutex_init(&mutex_, nullptr);
  }
  PriorityMutex(const PriorityMutex&) = delete;
  PriorityMutex& operator=(const PriorityMutex&) = delete;
  ~PriorityMutex() { ::pthread_mutex_destroy(&mutex_); }

  void lock() { ::pthread_mutex_lock(&mutex_); }
  bool try_lock() { return ::pthread_mutex_trylock(&mutex_) == 0; }
  void unlock() { ::pthread_mutex_unlock(&mutex_); }

  /// True if the kernel supports priority inheritance.
  bool inherits() const { return inherits_; }

 private:
  pthread_mutex_t mutex_;
  bool inherits_ = false;
};

}  // namespace orbwatch::hal
