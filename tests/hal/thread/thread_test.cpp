// SPDX-License-Identifier: Apache-2.0
#include "hal/thread/thread.h"

#include <gtest/gtest.h>

#include <array>
#include <atomic>
#include <chrono>
#include <condition_variable>
#include <future>
#include <latch>
#include <mutex>
#include <string>

#include <pthread.h>

namespace orbwatch::hal {
namespace {

using namespace std::chrono_literals;

std::string name_of_this_thread() {
  std::array<char, 64> name{};
  ::pthread_getname_np(::pthread_self(), name.data(), name.size());
  return name.data();
}

TEST(Thread, HasItsName) {
  Thread thread;
  std::string name;
  thread.start("cam front", [&] { name = name_of_this_thread(); });
  thread.stop();
  EXPECT_EQ(name, "cam front");
}

TEST(Thread, CutsANameThatTheKernelDoesNotTake) {
  Thread thread;
  std::string name;
  thread.start("cam usb-046d_HD_Pro_Webcam", [&] { name = name_of_this_thread(); });
  thread.stop();
  EXPECT_EQ(name, "cam usb-046d_HD");
}

TEST(Thread, StopEndsAWaitAndWaitsForTheEnd) {
  Thread thread;
  std::latch waits(1);
  bool ended = false;
  thread.start("test", [&] {
    waits.count_down();
    while (thread.wait()) {
    }
    ended = true;
  });
  waits.wait();
  thread.stop();
  EXPECT_TRUE(ended);
  thread.stop();
}

TEST(Thread, ItsDestructorStops) {
  bool ended = false;
  {
    Thread thread;
    thread.start("test", [&] {
      while (thread.wait()) {
      }
      ended = true;
    });
  }
  EXPECT_TRUE(ended);
}

TEST(Thread, KeepsAWakeUntilItWaits) {
  Thread thread;
  thread.wake();  // before the start
  thread.wake();
  std::promise<bool> woken;
  thread.start("test", [&] { woken.set_value(thread.wait()); });
  EXPECT_TRUE(woken.get_future().get());
}

TEST(Thread, CountsSeveralWakesAsOne) {
  Thread thread;
  thread.wake();
  thread.wake();
  int waits = 0;
  std::latch woken(1);
  thread.start("test", [&] {
    while (thread.wait()) {
      ++waits;
      woken.count_down();
    }
  });
  woken.wait();
  thread.stop();
  EXPECT_EQ(waits, 1);
}

TEST(Thread, LosesNoWake) {
  Thread asks, answers;
  constexpr int kTimes = 20000;
  std::atomic<int> asked = 0, answered = 0;
  std::promise<void> done;
  answers.start("answers", [&] {
    while (answers.wait()) {
      answered = asked.load();
      asks.wake();
    }
  });
  asks.start("asks", [&] {
    for (int i = 1; i <= kTimes; ++i) {
      asked = i;
      answers.wake();
      while (answered != i) {
        if (!asks.wait()) return;
      }
    }
    done.set_value();
  });
  done.get_future().wait();
  EXPECT_EQ(answered, kTimes);
}

TEST(Thread, WaitsUntilAMoment) {
  Thread thread;
  const auto moment = Clock::now() + 20ms;
  std::promise<bool> result;
  TimePoint returned;
  thread.start("test", [&] {
    const bool goes_on = thread.wait_until(moment);
    returned = Clock::now();
    result.set_value(goes_on);
  });
  EXPECT_TRUE(result.get_future().get());
  EXPECT_GE(returned, moment);
}

TEST(Thread, SaysThatItWasStoppedAlsoWhenWokenOrLate) {
  Thread thread;
  std::latch begun(1), stopped(1);
  bool woken = true, late = true;
  thread.start("test", [&] {
    begun.count_down();
    stopped.wait();
    thread.wake();
    woken = thread.wait();
    late = thread.wait_until(TimePoint::min());
  });
  begun.wait();
  const std::stop_callback when_stopped(thread.stop_token(), [&] { stopped.count_down(); });
  thread.stop();
  EXPECT_FALSE(woken);
  EXPECT_FALSE(late);
}

TEST(Thread, MayBeStoppedOnItselfAndStartedAgain) {
  Thread thread;
  std::promise<void> stopped;
  thread.start("test", [&] {
    thread.stop();
    stopped.set_value();
  });
  stopped.get_future().wait();
  EXPECT_TRUE(thread.is_running()) << "nobody has waited for its end";
  EXPECT_TRUE(thread.stop_requested());
  std::promise<void> again;
  thread.start("test", [&] {
    again.set_value();
    while (thread.wait()) {
    }
  });
  again.get_future().wait();
  EXPECT_TRUE(thread.is_running());
  EXPECT_FALSE(thread.stop_requested());
  thread.stop();
  EXPECT_FALSE(thread.is_running());
}

TEST(Thread, ItsTokenEndsOtherWaits) {
  Thread thread;
  std::mutex mutex;
  std::condition_variable_any never;
  std::latch waits(1);
  bool ended = false;
  thread.start("test", [&] {
    std::unique_lock lock(mutex);
    waits.count_down();
    never.wait(lock, thread.stop_token(), [] { return false; });
    ended = true;
  });
  waits.wait();
  thread.stop();
  EXPECT_TRUE(ended);
}

TEST(Thread, CountsTheProcessorTimeOfAllItsRuns) {
  Thread thread;
  EXPECT_EQ(thread.cpu_time().count(), 0);
  std::chrono::nanoseconds before{0};
  for (int run = 0; run < 2; ++run) {
    std::promise<void> worked;
    thread.start("test", [&] {
      volatile int work = 0;
      while (work < 1'000'000) work = work + 1;
      worked.set_value();
      while (thread.wait()) {
      }
    });
    worked.get_future().wait();
    const auto during = thread.cpu_time();
    EXPECT_GT(during, before);
    thread.stop();
    before = thread.cpu_time();
    EXPECT_GE(before, during);
  }
}

}  // namespace
}  // namespace orbwatch::hal
