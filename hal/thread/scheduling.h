#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "hal/thread/thread_settings.h"
#include "proc/image/result.h"

namespace orbwatch::hal {

/// What a thread is for, by which the kernel schedules it; later ones are more urgent. Those of the
/// frame path are Worker and later.
enum class ThreadRole : std::uint8_t {
  Background,  ///< encodes, writes files, compiles views: SCHED_OTHER, nice 5
  Service,     ///< answers PLC and controller: SCHED_OTHER
  Worker,      ///< shares the pipeline's work, which waits for it
  Pipeline,
  Capture,  ///< a camera's: a driver's buffer waits for it
  Lines,    ///< digital inputs and outputs: microseconds of work, whose moment counts
};

/// Of SCHED_FIFO; 0: the role is not of the frame path. All are below the threads that a kernel
/// with PREEMPT_RT makes of its interrupts (50), without which no frame comes.
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

/// What the kernel allowed of ThreadSettings.
struct ThreadGrants {
  bool realtime = false;
  bool memory_locked = false;
  std::vector<std::string> refusals;  ///< what was asked for in vain, why, and what would allow it
};

/// The cores that this process may use, ascending. Reentrant.
std::vector<int> usable_cores();

/// Whether the computer has the cores. The error names key and cores.
Result<> check(const ThreadSettings& settings);

/// Schedules the threads that hal::Thread starts from now on by their roles, and locks the memory.
/// Without it they are as any thread of the program. `settings` passed check(). Before threads of
/// the frame path start.
ThreadGrants schedule_threads(const ThreadSettings& settings);

/// For hal::Thread: the calling thread has this role.
void schedule_this_thread(ThreadRole role);

}  // namespace orbwatch::hal
