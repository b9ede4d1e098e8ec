// SPDX-License-Identifier: Apache-2.0
#include "hal/thread/priority_mutex.h"

#include <gtest/gtest.h>
#include <sched.h>
#include <unistd.h>

#include <atomic>
#include <cerrno>
#include <chrono>
#include <fstream>
#include <mutex>
#include <sstream>
#include <string>
#include <thread>

namespace orbwatch::hal {
namespace {

constexpr int kPriority = 10;

/// Priority by which the kernel schedules the thread now: -1 - priority for a real-time thread,
/// otherwise 0 or more.
int kernel_priority(pid_t thread) {
  std::ifstream in("/proc/self/task/" + std::to_string(thread) + "/stat");
  std::string text{std::istreambuf_iterator<char>(in), {}};
  std::istringstream fields(text.substr(text.rfind(')') + 1));
  std::string field;
  for (int i = 3; i <= 18; ++i) fields >> field;  // priority: the 18th in proc(5)
  return std::stoi(field);
}

TEST(PriorityMutex, ExcludesOthers) {
  PriorityMutex mutex;
  const std::lock_guard lock(mutex);
  bool was_free = true;
  std::thread([&] { was_free = mutex.try_lock(); }).join();
  EXPECT_FALSE(was_free);
}

TEST(PriorityMutex, LendsThePriorityOfWhoWaitsToWhoHoldsIt) {
  PriorityMutex mutex;
  if (!mutex.inherits()) GTEST_SKIP() << "the kernel has no priority inheritance";
  const pid_t holder = ::gettid();
  std::unique_lock lock(mutex);
  const int before = kernel_priority(holder);
  std::atomic<int> refused{-1};
  std::thread urgent([&] {
    const sched_param parameters{kPriority};
    refused = ::sched_setscheduler(0, SCHED_FIFO, &parameters) == 0 ? 0 : errno;
    refused.notify_all();
    const std::lock_guard waits(mutex);
  });
  refused.wait(-1);
  const auto give_up = std::chrono::steady_clock::now() + std::chrono::seconds(30);
  while (refused == 0 && kernel_priority(holder) == before &&
         std::chrono::steady_clock::now() < give_up) {
    std::this_thread::yield();
  }
  const int meanwhile = kernel_priority(holder);
  lock.unlock();
  urgent.join();
  if (refused != 0) GTEST_SKIP() << "no real-time priorities here";
  EXPECT_EQ(meanwhile, -1 - kPriority);
  EXPECT_EQ(kernel_priority(holder), before) << "it is given back";
}

}  // namespace
}  // namespace orbwatch::hal
