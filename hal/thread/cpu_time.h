// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <chrono>
#include <ctime>

namespace orbwatch::hal {

/// Processor time by the clock `id`: CLOCK_THREAD_CPUTIME_ID, or that of another thread
/// (pthread_getcpuclockid); 0 when that has ended. Reentrant; a system call of about 0.3 us.
inline std::chrono::nanoseconds cpu_time(clockid_t id) {
  timespec time{};
  ::clock_gettime(id, &time);
  return std::chrono::seconds(time.tv_sec) + std::chrono::nanoseconds(time.tv_nsec);
}

inline std::chrono::nanoseconds cpu_time_of_this_thread() {
  return cpu_time(CLOCK_THREAD_CPUTIME_ID);
}

}  // namespace orbwatch::hal
