// SPDX-License-Identifier: Apache-2.0
#include "app/pipeline/worker_pool.h"

#include <gtest/gtest.h>
#include <signal.h>
#include <sys/syscall.h>
#include <unistd.h>

#include <array>
#include <atomic>
#include <barrier>
#include <chrono>
#include <fstream>
#include <string>
#include <thread>

namespace orbwatch::app::pipeline {
namespace {

/// Waits until a thread sleeps: it then holds no lock that others need.
void wait_until_asleep(pid_t thread) {
  const std::string path = "/proc/self/task/" + std::to_string(thread) + "/stat";
  const auto state = [&path] {
    std::ifstream file(path);
    std::string text;
    std::getline(file, text);
    return text[text.rfind(')') + 2];
  };
  while (state() != 'S') std::this_thread::yield();
}

/// Keeps a thread from running, like a kernel with more urgent threads: in a signal handler, until
/// it is destroyed.
class Descheduled {
 public:
  explicit Descheduled(pid_t thread) {
    static const bool made = pipe(held) == 0 && pipe(released) == 0;
    EXPECT_TRUE(made);
    struct sigaction action {};
    action.sa_handler = [](int) {
      write_byte(held[1]);
      read_byte(released[0]);
      write_byte(held[1]);
    };
    EXPECT_EQ(sigaction(SIGUSR1, &action, nullptr), 0);
    wait_until_asleep(thread);
    EXPECT_EQ(syscall(SYS_tgkill, getpid(), thread, SIGUSR1), 0);
    read_byte(held[0]);
  }
  ~Descheduled() {
    write_byte(released[1]);
    read_byte(held[0]);
  }

 private:
  static void read_byte(int file) {
    char byte = 0;
    EXPECT_EQ(read(file, &byte, 1), 1);
  }
  static void write_byte(int file) {
    const char byte = 0;
    EXPECT_EQ(write(file, &byte, 1), 1);
  }

  static inline int held[2], released[2];
};

/// Thread of a pool's only worker.
pid_t thread_of_worker(WorkerPool& pool) {
  const pid_t own = gettid();
  std::atomic<pid_t> other{0};
  std::barrier both(2);  // each thread does one band
  auto work = [&](int) {
    if (gettid() != own) other = gettid();
    both.arrive_and_wait();
  };
  pool.run(2, work);
  return other;
}

TEST(WorkerPool, DoesEachBandOnceAndAllBeforeItReturns) {
  for (const std::size_t threads : {0, 1, 4}) {
    WorkerPool pool(threads);
    for (int round = 0; round < 500; ++round) {
      std::array<int, 37> done{};
      auto work = [&](int band) { ++done[static_cast<std::size_t>(band)]; };
      pool.run(static_cast<int>(done.size()), work);
      for (const int times : done) ASSERT_EQ(times, 1) << threads << " threads, round " << round;
    }
  }
}

TEST(WorkerPool, DoesNotWaitForAWorkerThatDoesNotRun) {
  WorkerPool pool(1);
  const Descheduled worker(thread_of_worker(pool));
  for (int round = 0; round < 3; ++round) {
    std::array<int, 5> done{};
    auto work = [&](int band) { ++done[static_cast<std::size_t>(band)]; };
    pool.run(static_cast<int>(done.size()), work);  // otherwise this never ends
    for (const int times : done) ASSERT_EQ(times, 1);
  }
}

TEST(WorkerPool, AWorkerThatWokeLateDoesBandsOfLaterRunsOnly) {
  WorkerPool pool(1);
  const pid_t thread = thread_of_worker(pool);
  for (int round = 0; round < 200; ++round) {
    {
      const Descheduled worker(thread);
      auto earlier = [](int) {};
      pool.run(2, earlier);
    }
    std::atomic<int> done{0};
    auto work = [&](int) { ++done; };
    pool.run(2, work);
    ASSERT_EQ(done, 2) << "round " << round;
  }
}

TEST(WorkerPool, CountsTheProcessorTimeOfItsWorkers) {
  WorkerPool pool(1);
  thread_of_worker(pool);
  EXPECT_GT(pool.take_spent().count(), 0);
  EXPECT_EQ(pool.take_spent().count(), 0) << "it counts from the last call";
  WorkerPool none(0);
  auto work = [](int) {};
  none.run(3, work);
  EXPECT_EQ(none.take_spent().count(), 0) << "the caller's own is not counted";
}

TEST(WorkerPool, NothingToDoIsDoneAtOnce) {
  WorkerPool pool(2);
  auto work = [](int) { FAIL(); };
  pool.run(0, work);
}

}  // namespace
}  // namespace orbwatch::app::pipeline
