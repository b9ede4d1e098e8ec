// SPDX-License-Identifier: Apache-2.0
#include "hal/thread/shared_threads.h"

#include <gtest/gtest.h>

#include <array>
#include <atomic>
#include <latch>
#include <memory>
#include <semaphore>
#include <vector>

namespace orbwatch::hal {
namespace {

using namespace std::chrono_literals;

TEST(SharedThreads, DoWhatWasRequestedFirstFirst) {
  const auto threads = SharedThreads::alone();
  std::latch may_begin(1), done(1);
  std::vector<int> order;
  SharedThreads::Work blocks(threads, [&] { may_begin.wait(); });
  SharedThreads::Work one(threads, [&] { order.push_back(1); });
  SharedThreads::Work two(threads, [&] { order.push_back(2); });
  SharedThreads::Work last(threads, [&] { done.count_down(); });
  blocks.request(Clock::now() - 1h);
  two.request(Clock::now() - 3s);
  one.request(Clock::now() - 2s);
  two.request(Clock::now() - 1s);
  last.request();
  may_begin.count_down();
  done.wait();
  EXPECT_EQ(order, (std::vector{2, 1})) << "several requests are one, by the earliest";
}

TEST(SharedThreads, LoseNoRequestAndDoEachWorkOnOneThreadAtATime) {
  const auto threads = std::make_shared<SharedThreads>("test", ThreadRole::Background, 3);
  std::atomic<int> at_once{0}, asked{0}, seen{0};
  std::counting_semaphore<> answered(0);
  SharedThreads::Work work(threads, [&] {
    EXPECT_EQ(++at_once, 1);
    seen = asked.load();
    --at_once;
    answered.release();
  });
  for (int n = 1; n <= 5000; ++n) {
    asked = n;
    work.request();
    while (seen != n) answered.acquire();
  }
}

TEST(SharedThreads, AreSeveral) {
  const auto threads = std::make_shared<SharedThreads>("test", ThreadRole::Background, 2);
  std::latch both(2);
  SharedThreads::Work one(threads, [&] { both.arrive_and_wait(); });
  SharedThreads::Work two(threads, [&] { both.arrive_and_wait(); });
  one.request();
  two.request();
  both.wait();  // otherwise one waits for the other forever
}

TEST(SharedThreads, CallABodyWhenItIsDue) {
  const auto threads = SharedThreads::alone();
  std::latch called(3);
  const auto begin = Clock::now();
  std::unique_ptr<SharedThreads::Work> work;
  work = std::make_unique<SharedThreads::Work>(threads, [&] {
    called.count_down();
    if (!called.try_wait()) work->request(Clock::now() + 5ms);
  });
  SharedThreads::Work later(threads, [] { FAIL() << "in an hour"; });
  later.request(begin + 1h);
  work->request(begin + 5ms);
  called.wait();
  EXPECT_GE(Clock::now() - begin, 15ms);
  work->cancel();
}

TEST(SharedThreads, CancellingWaitsForTheEndAndForgetsTheRest) {
  const auto threads = SharedThreads::alone();
  std::latch begun(1);
  std::atomic<int> calls{0};
  bool ended = false;
  std::unique_ptr<SharedThreads::Work> work;
  work = std::make_unique<SharedThreads::Work>(threads, [&] {
    if (++calls == 1) begun.count_down();
    work->request();
    ended = true;
  });
  work->request();
  begun.wait();
  work->cancel();
  EXPECT_TRUE(ended);
  const int before = calls;
  std::latch other(1);
  SharedThreads::Work next(threads, [&] { other.count_down(); });
  next.request();
  other.wait();
  EXPECT_EQ(calls, before);
  EXPECT_GT(work->cpu_time().count(), 0);
}

}  // namespace
}  // namespace orbwatch::hal
