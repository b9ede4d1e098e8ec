// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "hal/thread/thread_settings.h"
#include "proc/image/result.h"

namespace orbwatch::hal {

/// Purpose of a thread, which determines its scheduling; later ones are more urgent. The frame path
/// uses Worker and later.
enum class ThreadRole : std::uint8_t {
  Background,  ///< encodes, writes files, compiles views: SCHED_OTHER, nice 5
  Service,     ///< answers a PLC or controller: SCHED_OTHER
  Worker,      ///< shares the work of the pipeline, which waits for it
  Pipeline,
  Capture,  ///< thread of a camera: a driver's buffer waits for it
  Lines,    ///< digital inputs and outputs: microseconds of work, time-critical
};

/// Priority under SCHED_FIFO; 0: the role is not part of the frame path. All are below the
/// interrupt threads of a kernel with PREEMPT_RT (50), without which no frame arrives.
constexpr int fifo_priority(ThreadRole role) {
  switch (role) {
    case ThreadRole::Background:
    case ThreadRole::Service:
      return 0;
    case ThreadRole::Worker:
    case ThreadRole::Pipeline:
      return 40;
    case ThreadRole::Capture:
      return 44;
    case ThreadRole::Lines:
      return 48;
  }
  return 0;
}

/// Permissions that the kernel granted for ThreadSettings.
struct ThreadGrants {
  bool realtime = false;
  bool memory_locked = false;
  std::vector<std::string> refusals;  ///< refused requests, with reason and remedy
};

/// Cores that this process may use, ascending. Reentrant.
std::vector<int> usable_cores();

/// Checks that the computer has the cores. The error names key and cores.
Result<> check(const ThreadSettings& settings);

/// Schedules the threads that hal::Thread starts from now on by their roles, and locks the memory.
/// Without this call they have the program's default scheduling. `settings` passed check(). Call
/// before threads of the frame path start.
ThreadGrants schedule_threads(const ThreadSettings& settings);

/// For hal::Thread: gives the calling thread this role.
void schedule_this_thread(ThreadRole role);

}  // namespace orbwatch::hal
