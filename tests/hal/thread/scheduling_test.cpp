// SPDX-License-Identifier: Apache-2.0
#include "hal/thread/scheduling.h"

#include <gtest/gtest.h>
#include <linux/capability.h>
#include <pthread.h>
#include <sched.h>
#include <sys/resource.h>
#include <sys/syscall.h>
#include <unistd.h>

#include <algorithm>
#include <cstdio>
#include <cstdlib>
#include <map>
#include <string>

#include "hal/thread/thread.h"

namespace orbwatch::hal {
namespace {

constexpr ThreadSettings kNothing{.realtime = false, .lock_memory = false, .cores = {}};

struct Scheduled {
  int policy = 0;
  int priority = 0;
  int nice = 0;
  std::vector<int> cores;
};

Scheduled scheduled(ThreadRole role) {
  Scheduled seen;
  Thread thread;
  thread.start("test", role, [&seen] {
    sched_param parameters{};
    ::pthread_getschedparam(::pthread_self(), &seen.policy, &parameters);
    seen.priority = parameters.sched_priority;
    seen.nice = ::getpriority(PRIO_PROCESS, static_cast<id_t>(::gettid()));
    seen.cores = usable_cores();
  });
  thread.stop();
  return seen;
}

/// Gives up the privileges, so that the process is an ordinary user's.
void drop_privileges() {
  __user_cap_header_struct header{_LINUX_CAPABILITY_VERSION_3, 0};
  __user_cap_data_struct none[_LINUX_CAPABILITY_U32S_3]{};
  rlimit no_priority{0, 0}, few_pages{65536, 65536};
  if (::setrlimit(RLIMIT_RTPRIO, &no_priority) != 0 ||
      ::setrlimit(RLIMIT_MEMLOCK, &few_pages) != 0 || ::syscall(SYS_capset, &header, none) != 0) {
    std::abort();
  }
}

class Scheduling : public testing::Test {
 protected:
  ~Scheduling() override { schedule_threads(kNothing); }  // the process outlives this test
};

TEST_F(Scheduling, TheFramePathComesFirstAndItsOrderIsThatOfTheRoles) {
  EXPECT_GT(fifo_priority(ThreadRole::Lines), fifo_priority(ThreadRole::Capture));
  EXPECT_GT(fifo_priority(ThreadRole::Capture), fifo_priority(ThreadRole::Pipeline));
  EXPECT_EQ(fifo_priority(ThreadRole::Pipeline), fifo_priority(ThreadRole::Worker))
      << "the pipeline waits for its workers";
  EXPECT_LT(fifo_priority(ThreadRole::Lines), 50) << "interrupts of a PREEMPT_RT kernel";

  ThreadSettings settings = kNothing;
  settings.realtime = true;
  const ThreadGrants grants = schedule_threads(settings);
  EXPECT_EQ(grants.realtime, grants.refusals.empty());
  for (const auto role :
       {ThreadRole::Worker, ThreadRole::Pipeline, ThreadRole::Capture, ThreadRole::Lines}) {
    const Scheduled seen = scheduled(role);
    EXPECT_EQ(seen.policy & ~SCHED_RESET_ON_FORK, grants.realtime ? SCHED_FIFO : SCHED_OTHER);
    EXPECT_EQ(seen.priority, grants.realtime ? fifo_priority(role) : 0);
  }
  const int own_nice = ::getpriority(PRIO_PROCESS, 0);
  EXPECT_EQ(scheduled(ThreadRole::Service).policy, SCHED_OTHER);
  EXPECT_EQ(scheduled(ThreadRole::Service).nice, own_nice);
  EXPECT_EQ(scheduled(ThreadRole::Background).policy, SCHED_OTHER);
  EXPECT_EQ(scheduled(ThreadRole::Background).nice, std::min(19, std::max(5, own_nice)));
}

TEST_F(Scheduling, ThreadsOfLibrariesDoNotInheritThePriority) {
  ThreadSettings settings = kNothing;
  settings.realtime = true;
  schedule_threads(settings);
  int policy = -1;
  Thread thread;
  thread.start("test", ThreadRole::Capture,
               [&policy] { std::thread([&policy] { policy = ::sched_getscheduler(0); }).join(); });
  thread.stop();
  EXPECT_EQ(policy, SCHED_OTHER);
}

TEST_F(Scheduling, OnlyTheFramePathKeepsToItsCores) {
  const std::vector<int> all = usable_cores();
  ThreadSettings settings = kNothing;
  settings.cores = {all.back()};
  ASSERT_TRUE(check(settings));
  EXPECT_TRUE(schedule_threads(settings).refusals.empty());
  for (const auto role : {ThreadRole::Worker, ThreadRole::Pipeline, ThreadRole::Capture}) {
    EXPECT_EQ(scheduled(role).cores, settings.cores);
  }
  for (const auto role : {ThreadRole::Background, ThreadRole::Service}) {
    EXPECT_EQ(scheduled(role).cores, all);
  }
}

TEST(SchedulingCheck, RefusesCoresThatAreNotThere) {
  ThreadSettings settings;
  EXPECT_TRUE(check(settings));
  settings.cores = {usable_cores().front(), 1023};
  const auto checked = check(settings);
  ASSERT_FALSE(checked);
  const std::string& said = checked.error().message;
  EXPECT_NE(said.find("threads.cores: there is no core 1023"), std::string::npos) << said;
  EXPECT_NE(said.find("use some of " + std::to_string(usable_cores().front())), std::string::npos)
      << said;
}

TEST(SchedulingDeathTest, SaysOnceWhatTheKernelRefusesAndWhatWouldAllowIt) {
  EXPECT_EXIT(
      {
        drop_privileges();
        const ThreadGrants grants = schedule_threads(ThreadSettings{});
        for (const std::string& refusal : grants.refusals) {
          std::fprintf(stderr, "%s\n", refusal.c_str());
        }
        const bool as_any = scheduled(ThreadRole::Lines).policy == SCHED_OTHER;
        std::exit(!grants.realtime && !grants.memory_locked && as_any ? 0 : 1);
      },
      testing::ExitedWithCode(0),
      "no real-time priorities \\(Operation not permitted\\).*LimitRTPRIO=48.*\n"
      "memory is not locked .*LimitMEMLOCK=infinity");
}

TEST(SchedulingDeathTest, LocksMemoryThatIsUsedWithoutALimit) {
  const auto lock = [] {
    const rlimit none{RLIM_INFINITY, RLIM_INFINITY};
    if (::setrlimit(RLIMIT_MEMLOCK, &none) != 0) std::exit(0);  // needs root
    ThreadSettings settings = kNothing;
    settings.lock_memory = true;
    std::exit(schedule_threads(settings).memory_locked ? 0 : 1);
  };
  EXPECT_EXIT(lock(), testing::ExitedWithCode(0), "");
}

}  // namespace
}  // namespace orbwatch::hal
