#include "app/modbus/result_queue.h"

#include <gtest/gtest.h>

#include <deque>
#include <random>

namespace orbwatch::app::modbus {
namespace {

Moment result(std::uint64_t number) {
  Moment moment;
  moment.status.result = number;
  moment.status.frame_set = 1000 + number;
  moment.utc = std::chrono::microseconds(number);
  return moment;
}

TEST(ResultQueue, ShowsTheOldestUntilItIsTaken) {
  ResultQueue queue;
  EXPECT_EQ(queue.waiting().count, 0U);
  EXPECT_EQ(queue.waiting().oldest.status.result, 0U);
  queue.push(result(1));
  queue.push(result(2));
  EXPECT_EQ(queue.waiting().oldest.status.result, 1U);
  queue.take(1);
  EXPECT_EQ(queue.waiting().oldest.status.frame_set, 1002U);
  EXPECT_EQ(queue.waiting().last_taken, 1U);
  queue.take(2);
  EXPECT_EQ(queue.waiting().oldest.status.result, 0U);
  EXPECT_EQ(queue.waiting().last_taken, 2U);
}

TEST(ResultQueue, TakesNothingButTheOldest) {
  ResultQueue queue;
  queue.take(0);
  queue.take(1);
  for (const std::uint64_t number : {5, 6, 7}) queue.push(result(number));
  for (const std::uint32_t other : {0, 4, 6, 7, 8}) queue.take(other);
  EXPECT_EQ(queue.waiting().count, 3U);
  EXPECT_EQ(queue.waiting().last_taken, 0U);
  queue.take(5);
  queue.take(5);  // a repeated write
  EXPECT_EQ(queue.waiting().oldest.status.result, 6U);
}

TEST(ResultQueue, RefusesTheNewestWhenFullAndSaysSoUntilItIsEmpty) {
  ResultQueue queue;
  for (std::uint64_t number = 1; number <= 10; ++number) queue.push(result(number));
  EXPECT_EQ(queue.waiting().count, 8U);
  EXPECT_EQ(queue.waiting().refused, 2U);
  EXPECT_TRUE(queue.waiting().any_refused);
  for (std::uint32_t number = 1; number <= 8; ++number) {
    EXPECT_TRUE(queue.waiting().any_refused);
    EXPECT_EQ(queue.waiting().oldest.status.result, number);
    queue.take(number);
  }
  EXPECT_FALSE(queue.waiting().any_refused);
  EXPECT_EQ(queue.waiting().refused, 2U);
  queue.push(result(11));  // the gap tells which were refused
  EXPECT_EQ(queue.waiting().oldest.status.result, 11U);
  EXPECT_FALSE(queue.waiting().any_refused);
}

TEST(ResultQueue, NumbersAreComparedAsTheRegistersHoldThem) {
  ResultQueue queue;
  queue.push(result(0x1'0000'0003));
  queue.take(3);
  EXPECT_EQ(queue.waiting().count, 0U);
  EXPECT_EQ(queue.waiting().last_taken, 3U);
}

TEST(ResultQueue, BehavesAsADequeWhateverHappens) {
  ResultQueue queue;
  std::deque<std::uint64_t> model;
  std::uint64_t refused = 0;
  std::mt19937 random(7);
  std::uint64_t number = 0;
  for (int step = 0; step < 20000; ++step) {
    if (random() % 2 == 0) {
      queue.push(result(++number));
      if (model.size() < 8) {
        model.push_back(number);
      } else {
        ++refused;
      }
    } else {
      const auto taken = static_cast<std::uint32_t>(number - random() % 10);
      if (!model.empty() && model.front() == taken) model.pop_front();
      queue.take(taken);
    }
    const WaitingResults waiting = queue.waiting();
    ASSERT_EQ(waiting.count, model.size());
    ASSERT_EQ(waiting.refused, refused);
    ASSERT_EQ(waiting.oldest.status.result, model.empty() ? 0 : model.front());
    ASSERT_EQ(waiting.oldest.utc.count(), model.empty() ? 0 : model.front());
  }
  EXPECT_GT(refused, 100U);
}

}  // namespace
}  // namespace orbwatch::app::modbus
