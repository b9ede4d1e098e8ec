// SPDX-License-Identifier: Apache-2.0
#include "app/ports/web/http/connections.h"

#include <gtest/gtest.h>
#include <sys/socket.h>

#include <algorithm>
#include <array>
#include <atomic>
#include <memory>
#include <thread>
#include <vector>

#include "hal/thread/file_descriptor.h"

namespace orbwatch::app::web {
namespace {

using std::chrono::seconds;

constexpr seconds kTimeout{5};

/// A connected pair of sockets: the server's end and the client's.
class Pair {
 public:
  Pair() {
    std::array<int, 2> ends{-1, -1};
    EXPECT_EQ(::socketpair(AF_UNIX, SOCK_STREAM, 0, ends.data()), 0);
    server_ = hal::FileDescriptor(ends[0]);
    client_ = hal::FileDescriptor(ends[1]);
  }

  int server() const { return server_.get(); }
  /// Ends the client's sending direction.
  void half_close() const { ::shutdown(client_.get(), SHUT_WR); }
  /// Returns whether the client sees the end.
  bool is_shut() const {
    char byte = 0;
    return ::recv(client_.get(), &byte, 1, MSG_DONTWAIT) == 0;
  }

 private:
  hal::FileDescriptor server_, client_;
};

TEST(Connections, ManyAtOnceOfAnAddressAreNoMoreThanItsShare) {
  constexpr std::size_t kMost = 8, kEach = 20;
  for (int round = 0; round < 50; ++round) {
    Connections connections(kTimeout);
    std::array<std::array<Pair, kEach>, 2> pairs;
    std::atomic<std::size_t> open{0};
    {
      std::vector<std::jthread> threads;
      for (const auto& of_thread : pairs) {
        threads.emplace_back([&] {
          for (const Pair& pair : of_thread) {
            if (!connections.add(pair.server(), "10.0.0.7", kMost)->is_beyond) ++open;
          }
        });
      }
    }
    ASSERT_EQ(open, kMost);
    std::size_t shut = 0;
    for (const auto& of_thread : pairs)
      shut += static_cast<std::size_t>(std::ranges::count_if(of_thread, &Pair::is_shut));
    ASSERT_EQ(shut, 2 * kEach - kMost);
  }
}

TEST(Connections, OneThatIsBeyondTakesNoPlaceAndIsAskedNothing) {
  Connections connections(kTimeout);
  const Pair first, beyond, next, other;
  auto* const kept = connections.add(first.server(), "10.0.0.7", 1);
  auto* const turned_away = connections.add(beyond.server(), "10.0.0.7", 1);
  EXPECT_TRUE(turned_away->is_beyond);
  EXPECT_FALSE(connections.begin_answer(turned_away, nullptr));
  EXPECT_FALSE(connections.add(other.server(), "10.0.0.8", 1)->is_beyond);
  connections.remove(kept);
  EXPECT_FALSE(connections.add(next.server(), "10.0.0.7", 1)->is_beyond);
}

TEST(Connections, OneThatIsOverdueIsCountedOnceHoweverLateItIsRemoved) {
  Connections connections(kTimeout);
  const Pair pair;
  auto* const connection = connections.add(pair.server(), "10.0.0.7", 1);
  EXPECT_EQ(connections.end_overdue(connection->deadline - seconds(1)), 0U);
  EXPECT_FALSE(pair.is_shut());
  const auto late = connection->deadline + seconds(1);
  EXPECT_EQ(connections.end_overdue(late), 1U);
  EXPECT_TRUE(pair.is_shut());
  EXPECT_EQ(connections.end_overdue(late), 0U);
}

TEST(Connections, AClientThatHasGoneKeepsNoPlaceUnlessItsAnswerIsUnderWay) {
  Connections connections(kTimeout);
  const Pair silent, answered, there;
  auto* const gone = connections.add(silent.server(), "10.0.0.7", 8);
  auto* const asking = connections.add(answered.server(), "10.0.0.7", 8);
  connections.add(there.server(), "10.0.0.7", 8);
  const auto exchange = std::make_shared<Exchange>(Request{});
  EXPECT_TRUE(connections.begin_answer(asking, exchange));
  silent.half_close();
  answered.half_close();
  const auto now = gone->deadline - seconds(1);
  EXPECT_EQ(connections.end_overdue(now), 0U);
  EXPECT_FALSE(silent.is_shut()) << "what it sent before may still be read";
  EXPECT_EQ(connections.end_overdue(now), 0U);
  EXPECT_TRUE(silent.is_shut());
  EXPECT_FALSE(answered.is_shut()) << "it may read what it asked for";
  EXPECT_TRUE(exchange->is_answered());
  EXPECT_FALSE(there.is_shut());
}

TEST(Connections, WhatHasTakenEffectIsNotAnsweredByTheDeadline) {
  Connections connections(kTimeout);
  const Pair pair;
  auto* const connection = connections.add(pair.server(), "10.0.0.7", 1);
  const auto exchange = std::make_shared<Exchange>(Request{});
  ASSERT_TRUE(connections.begin_answer(connection, exchange));
  ASSERT_TRUE(exchange->begin_effect());
  connections.end_overdue(connection->deadline + seconds(1));
  EXPECT_FALSE(exchange->is_answered());
  EXPECT_TRUE(exchange->answer({}));
  EXPECT_FALSE(exchange->begin_effect()) << "the client has its answer";
}

TEST(Connections, TheirEndWaitsForAnswersThatAreBeingSent) {
  Connections connections(kTimeout);
  const Pair pair;
  auto* const connection = connections.add(pair.server(), "10.0.0.7", 1);
  const auto exchange = std::make_shared<Exchange>(Request{});
  ASSERT_TRUE(connections.begin_answer(connection, exchange));
  ASSERT_TRUE(exchange->begin_effect());
  std::atomic<bool> is_sent{false};
  std::jthread server([&] {
    exchange->answer({});
    connections.begin_sending(connection);
    is_sent = true;
    connections.end_answer(connection);
  });
  connections.end_all();
  EXPECT_TRUE(is_sent);
}

}  // namespace
}  // namespace orbwatch::app::web
