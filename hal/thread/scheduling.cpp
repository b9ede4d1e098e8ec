// SPDX-License-Identifier: Apache-2.0
#include "hal/thread/scheduling.h"

#include <linux/capability.h>
#include <pthread.h>
#include <sched.h>
#include <sys/mman.h>
#include <sys/resource.h>
#include <sys/syscall.h>
#include <unistd.h>

#include <algorithm>
#include <atomic>
#include <cerrno>
#include <mutex>
#include <system_error>
#include <thread>

namespace orbwatch::hal {
namespace {

constexpr int kBackgroundNice = 5;

/// Scheduling of the process, set by schedule_threads(); the log's thread may have started before.
struct Scheduling {
  bool by_role = false;
  bool realtime = false;
  std::vector<int> cores;
};
Scheduling scheduling;        // NOLINT(cppcoreguidelines-avoid-non-const-global-variables)
std::mutex scheduling_mutex;  // NOLINT(cppcoreguidelines-avoid-non-const-global-variables)

Scheduling present_scheduling() {
  const std::lock_guard lock(scheduling_mutex);
  return scheduling;
}

/// Schedules the calling thread with SCHED_FIFO; threads that it creates itself, for example in a
/// library, do not inherit it. Returns errno, or 0.
int run_first_in_first_out(int priority) {
  const sched_param parameters{priority};
  const int policy = SCHED_FIFO | SCHED_RESET_ON_FORK;
  return ::sched_setscheduler(0, policy, &parameters) == 0 ? 0 : errno;
}

/// Attempted on a thread of its own, so that the calling one keeps its scheduling.
int try_realtime() {
  int error = 0;
  std::thread([&error] {
    error = run_first_in_first_out(fifo_priority(ThreadRole::Lines));
  }).join();
  return error;
}

std::string reason(int error) { return std::generic_category().message(error); }

bool has_capability(unsigned capability) {
  __user_cap_header_struct header{_LINUX_CAPABILITY_VERSION_3, 0};
  __user_cap_data_struct data[_LINUX_CAPABILITY_U32S_3]{};
  if (::syscall(SYS_capget, &header, data) != 0) return false;
  return (data[CAP_TO_INDEX(capability)].effective & CAP_TO_MASK(capability)) != 0;
}

/// Under a limit, each mapping beyond it would fail later, and with it the process.
bool may_lock_all_memory() {
  rlimit limit{};
  if (::getrlimit(RLIMIT_MEMLOCK, &limit) == 0 && limit.rlim_cur == RLIM_INFINITY) return true;
  return has_capability(CAP_IPC_LOCK);
}

/// Pages are locked once they are used: stacks and pools occupy no memory before they need it.
std::string lock_memory() {
  if (!may_lock_all_memory()) return "the limit of locked memory is too low";
  const bool locked = ::mlockall(MCL_CURRENT | MCL_FUTURE | MCL_ONFAULT) == 0;
  return locked ? std::string() : reason(errno);
}

std::string text_of(const std::vector<int>& cores) {
  std::string text;
  for (const int core : cores) text += (text.empty() ? "" : ", ") + std::to_string(core);
  return text;
}

void keep_to(const std::vector<int>& cores) {
  cpu_set_t set;
  CPU_ZERO(&set);
  for (const int core : cores) CPU_SET(static_cast<std::size_t>(core), &set);
  // This fails when all of the cores were switched off since check(): then any core is better than
  // none.
  static_cast<void>(::pthread_setaffinity_np(::pthread_self(), sizeof set, &set));
}

}  // namespace

std::vector<int> usable_cores() {
  cpu_set_t set;
  CPU_ZERO(&set);
  std::vector<int> cores;
  if (::sched_getaffinity(0, sizeof set, &set) != 0) return cores;
  for (int core = 0; core < CPU_SETSIZE; ++core) {
    if (CPU_ISSET(static_cast<std::size_t>(core), &set)) cores.push_back(core);
  }
  return cores;
}

Result<> check(const ThreadSettings& settings) {
  const std::vector<int> usable = usable_cores();
  for (const int core : settings.cores) {
    if (std::ranges::find(usable, core) != usable.end()) continue;
    return fail("threads.cores: there is no core " + std::to_string(core) +
                " that this program may use; use some of " + text_of(usable));
  }
  return {};
}

ThreadGrants schedule_threads(const ThreadSettings& settings) {
  ThreadGrants grants;
  if (settings.realtime) {
    const int error = try_realtime();
    grants.realtime = error == 0;
    if (error != 0) {
      grants.refusals.push_back("no real-time priorities (" + reason(error) +
                                "): other programs can delay frames; LimitRTPRIO=" +
                                std::to_string(fifo_priority(ThreadRole::Lines)) +
                                " of the unit, or the capability CAP_SYS_NICE, allows them");
    }
  }
  if (settings.lock_memory) {
    const std::string refusal = lock_memory();
    grants.memory_locked = refusal.empty();
    if (!refusal.empty()) {
      grants.refusals.push_back("memory is not locked (" + refusal +
                                "): it can be swapped out; LimitMEMLOCK=infinity of the unit, or "
                                "the capability CAP_IPC_LOCK, allows it");
    }
  }
  const std::lock_guard lock(scheduling_mutex);
  scheduling = {true, grants.realtime, settings.cores};
  return grants;
}

void schedule_this_thread(ThreadRole role) {
  const Scheduling present = present_scheduling();
  if (!present.by_role) return;
  const int priority = fifo_priority(role);
  if (priority > 0 && role != ThreadRole::Lines && !present.cores.empty()) {
    keep_to(present.cores);
  }
  // Permitted already, or without effect; schedule_threads() has reported which.
  if (priority > 0 && present.realtime) run_first_in_first_out(priority);
  if (role == ThreadRole::Background) {
    const auto thread = static_cast<id_t>(::gettid());
    // A process that was started with nice stays there: its frame path comes first.
    const int nice = std::max(kBackgroundNice, ::getpriority(PRIO_PROCESS, thread));
    ::setpriority(PRIO_PROCESS, thread, nice);
  }
}

}  // namespace orbwatch::hal
