// SPDX-License-Identifier: Apache-2.0
#include "app/ports/modbus/result_queue.h"

#include <gtest/gtest.h>

#include <deque>
#include <random>

#include "app/model/status/result_number.h"

namespace orbwatch::app::modbus {
namespace {

StampedStatus result(std::uint64_t number) {
  StampedStatus stamped;
  stamped.status.result = number;
  stamped.status.frame_set = 1000 + number;
  stamped.utc = std::chrono::microseconds(number);
  return stamped;
}

TEST(ResultQueue, ShowsTheOldestUntilItIsAcknowledged) {
  ResultQueue queue;
  EXPECT_EQ(queue.status().count, 0U);
  EXPECT_EQ(queue.oldest().status.result, 0U);
  queue.push(result(1));
  queue.push(result(2));
  EXPECT_EQ(queue.oldest().status.result, 1U);
  queue.acknowledge(1);
  EXPECT_EQ(queue.oldest().status.frame_set, 1002U);
  EXPECT_EQ(queue.last_acknowledged(), 1U);
  queue.acknowledge(2);
  EXPECT_EQ(queue.oldest().status.result, 0U);
  EXPECT_EQ(queue.last_acknowledged(), 2U);
}

TEST(ResultQueue, OnlyTheOldestIsAcknowledged) {
  ResultQueue queue;
  queue.acknowledge(0);
  queue.acknowledge(1);
  for (const std::uint64_t number : {5, 6, 7}) queue.push(result(number));
  for (const std::uint32_t other : {0, 4, 6, 7, 8}) queue.acknowledge(other);
  EXPECT_EQ(queue.status().count, 3U);
  EXPECT_EQ(queue.last_acknowledged(), 0U);
  queue.acknowledge(5);
  queue.acknowledge(5);  // a repeated write
  EXPECT_EQ(queue.oldest().status.result, 6U);
}

TEST(ResultQueue, EachNumberCanBeAcknowledgedBeyond32Bits) {
  constexpr std::uint64_t kFirst = 0xffff'fffd;
  ResultQueue queue;
  std::uint64_t number = kFirst;
  for (int n = 0; n < 6; ++n, number = next_result(number)) {
    queue.push(result(number));
    const auto shown = static_cast<std::uint32_t>(queue.oldest().status.result);
    EXPECT_NE(shown, 0U) << "reads as no result";
    queue.acknowledge(shown);
    EXPECT_EQ(queue.status().count, 0U) << number;
  }
  EXPECT_EQ(number, kFirst + 7) << "one number is left out";
  EXPECT_EQ(next_result(0), 1U);
}

TEST(ResultQueue, RefusesTheNewestWhenFullAndSaysSoUntilItIsEmpty) {
  ResultQueue queue;
  for (std::uint64_t number = 1; number <= 10; ++number) queue.push(result(number));
  EXPECT_EQ(queue.status().count, 8U);
  EXPECT_EQ(queue.status().overruns, 2U);
  EXPECT_TRUE(queue.status().overrun);
  for (std::uint32_t number = 1; number <= 8; ++number) {
    EXPECT_TRUE(queue.status().overrun);
    EXPECT_EQ(queue.oldest().status.result, number);
    queue.acknowledge(number);
  }
  EXPECT_FALSE(queue.status().overrun);
  EXPECT_EQ(queue.status().overruns, 2U);
  queue.push(result(11));  // the gap shows the refused ones
  EXPECT_EQ(queue.oldest().status.result, 11U);
  EXPECT_FALSE(queue.status().overrun);
}

TEST(ResultQueue, NumbersAreComparedAsTheRegistersHoldThem) {
  ResultQueue queue;
  queue.push(result(0x1'0000'0003));
  queue.acknowledge(3);
  EXPECT_EQ(queue.status().count, 0U);
  EXPECT_EQ(queue.last_acknowledged(), 3U);
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
      const auto acknowledged = static_cast<std::uint32_t>(number - random() % 10);
      if (!model.empty() && model.front() == acknowledged) model.pop_front();
      queue.acknowledge(acknowledged);
    }
    ASSERT_EQ(queue.status().count, model.size());
    ASSERT_EQ(queue.status().overruns, refused);
    ASSERT_EQ(queue.oldest().status.result, model.empty() ? 0 : model.front());
    ASSERT_EQ(queue.oldest().utc.count(), model.empty() ? 0 : model.front());
  }
  EXPECT_GT(refused, 100U);
}

}  // namespace
}  // namespace orbwatch::app::modbus
