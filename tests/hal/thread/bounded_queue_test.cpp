// SPDX-License-Identifier: Apache-2.0
#include "hal/thread/bounded_queue.h"

#include <gtest/gtest.h>

#include <array>
#include <memory>
#include <optional>
#include <thread>

#include "hal/thread/thread.h"

namespace orbwatch::hal {
namespace {

TEST(BoundedQueue, TheOldestIsTakenFirst) {
  BoundedQueue<int, 3> queue;
  EXPECT_EQ(queue.try_take(), std::nullopt);
  for (int round = 0; round < 5; ++round) {  // also across the end of its memory
    EXPECT_TRUE(queue.put(round));
    EXPECT_TRUE(queue.put(-round));
    EXPECT_EQ(queue.try_take(), round);
    EXPECT_EQ(queue.try_take(), -round);
  }
  EXPECT_EQ(queue.try_take(), std::nullopt);
}

TEST(BoundedQueue, WhatDoesNotFitIsRefusedAndCounted) {
  BoundedQueue<int, 2> queue;
  EXPECT_TRUE(queue.put(1));
  EXPECT_TRUE(queue.put(2));
  EXPECT_FALSE(queue.put(3));
  EXPECT_FALSE(queue.put(4));
  EXPECT_EQ(queue.drops(), 2U);
  EXPECT_EQ(queue.try_take(), 1);
  EXPECT_TRUE(queue.put(5));
  EXPECT_EQ(queue.try_take(), 2);
  EXPECT_EQ(queue.try_take(), 5);
  EXPECT_EQ(queue.drops(), 2U);
}

TEST(BoundedQueue, AClientTakesAPartOfItsPlaces) {
  BoundedQueue<char, 4> queue;
  const auto put = [&queue](char client) {
    return queue.put(client, 2, [client](char other) { return other == client; });
  };
  EXPECT_TRUE(put('a'));
  EXPECT_TRUE(put('a'));
  EXPECT_FALSE(put('a'));
  EXPECT_TRUE(put('b'));
  EXPECT_EQ(queue.drops(), 1U);
  EXPECT_EQ(queue.try_take(), 'a');
  EXPECT_TRUE(put('a')) << "one of them was taken";
  EXPECT_TRUE(put('b'));
  EXPECT_FALSE(put('c')) << "the queue is full";
  EXPECT_EQ(queue.drops(), 2U);
}

TEST(BoundedQueue, KeepsNothingThatWasTakenOrRefused) {
  BoundedQueue<std::shared_ptr<int>, 1> queue;
  const auto value = std::make_shared<int>(1);
  EXPECT_TRUE(queue.put(value));
  EXPECT_FALSE(queue.put(value));
  EXPECT_EQ(value.use_count(), 2);
  queue.try_take();
  EXPECT_EQ(value.use_count(), 1);
}

TEST(BoundedQueue, EachValueIsTakenOnceOrCounted) {
  BoundedQueue<int, 4> queue;
  constexpr int kValues = 20000;
  std::array<int, 3> accepted{}, taken{};
  Thread receiver;
  const auto take_all = [&] {
    while (const auto sender = queue.try_take()) ++taken[static_cast<std::size_t>(*sender)];
  };
  receiver.start("receiver", [&] {
    while (receiver.wait()) take_all();
    take_all();
  });
  std::array<std::thread, 3> senders;
  for (int n = 0; n < 3; ++n) {
    const auto place = static_cast<std::size_t>(n);
    senders[place] = std::thread([&, n, place] {
      for (int i = 0; i < kValues; ++i) {
        if (!queue.put(n)) continue;
        ++accepted[place];
        receiver.wake();
      }
    });
  }
  for (std::thread& sender : senders) sender.join();
  receiver.stop();
  EXPECT_EQ(taken, accepted) << "the stop drained the queue";
  EXPECT_EQ(static_cast<int>(queue.drops()) + taken[0] + taken[1] + taken[2], 3 * kValues);
}

}  // namespace
}  // namespace orbwatch::hal
