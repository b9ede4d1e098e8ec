// SPDX-License-Identifier: Apache-2.0
#include "app/ports/web/http/connections.h"

#include <gtest/gtest.h>
#include <netinet/in.h>
#include <sys/socket.h>

#include <algorithm>
#include <array>
#include <atomic>
#include <cstddef>
#include <cstdint>
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

/// A connection over TCP, for which the kernel counts the bytes that the client has read.
class TcpPair {
 public:
  TcpPair() {
    const hal::FileDescriptor listener(::socket(AF_INET, SOCK_STREAM, 0));
    sockaddr_in address{};
    address.sin_family = AF_INET;
    address.sin_addr.s_addr = htonl(INADDR_LOOPBACK);
    socklen_t size = sizeof address;
    auto* const any = reinterpret_cast<sockaddr*>(&address);
    EXPECT_EQ(::bind(listener.get(), any, size), 0);
    EXPECT_EQ(::listen(listener.get(), 1), 0);
    EXPECT_EQ(::getsockname(listener.get(), any, &size), 0);
    client_ = hal::FileDescriptor(::socket(AF_INET, SOCK_STREAM, 0));
    EXPECT_EQ(::connect(client_.get(), any, size), 0);
    server_ = hal::FileDescriptor(::accept(listener.get(), nullptr, nullptr));
    EXPECT_TRUE(server_.is_open());
  }

  int server() const { return server_.get(); }
  /// Sends so many bytes to the client, which reads them.
  void pass_bytes(std::size_t count) const {
    std::jthread reader([&] {
      std::vector<char> bytes(count);
      EXPECT_EQ(::recv(client_.get(), bytes.data(), count, MSG_WAITALL),
                static_cast<ssize_t>(count));
    });
    const std::vector<char> bytes(count);
    EXPECT_EQ(::send(server_.get(), bytes.data(), count, 0), static_cast<ssize_t>(count));
  }

 private:
  hal::FileDescriptor client_, server_;
};

TEST(Connections, ALongAnswerGoesOnAsLongAsItsClientReads) {
  const TcpPair pair;
  Connections connections(kTimeout);
  auto* const connection = connections.add(pair.server(), "127.0.0.1", 1);
  ASSERT_TRUE(connections.begin_answer(connection, nullptr));
  connections.begin_sending(connection, {});
  for (int term = 0; term < 3; ++term) {
    pair.pass_bytes(4 * Connections::kLeastProgress);
    EXPECT_EQ(connections.end_overdue(connection->deadline), 0U) << "term " << term;
  }
  pair.pass_bytes(1);
  EXPECT_EQ(connections.end_overdue(connection->deadline), 1U) << "byte by byte";
}

/// An answer with a file of so many bytes, which is not open.
Response file_of(std::uint64_t size) {
  return file_response(kText,
                       std::make_shared<const OpenFile>(OpenFile{hal::FileDescriptor(), size}));
}

TEST(Connections, AFileIsReadAtTheLeastRateOnAverage) {
  constexpr std::uint64_t kRecording = 4'000'000'000;
  const TcpPair pair;
  Connections connections(kTimeout);
  auto* const connection = connections.add(pair.server(), "127.0.0.1", 1);
  ASSERT_TRUE(connections.begin_answer(connection, nullptr));
  connections.begin_sending(connection, file_of(kRecording));
  const hal::TimePoint begin = connection->deadline - kTimeout;
  const auto overdue_after = [&](seconds time) {
    pair.pass_bytes(4 * Connections::kLeastProgress);
    return connections.end_overdue(begin + time);
  };
  const seconds longest = kTimeout + seconds(kRecording / Connections::kLeastRate);
  EXPECT_EQ(overdue_after(std::chrono::hours(5)), 0U) << "over a VPN of 2 Mbit/s";
  EXPECT_EQ(overdue_after(longest - seconds(1)), 0U);
  EXPECT_EQ(overdue_after(longest), 1U) << "however much of it is read in each term";
}

TEST(Connections, AFileEndsWhenItsClientMayNotReceiveItAnyMore) {
  const Pair pair;
  Connections connections(kTimeout);
  auto* const connection = connections.add(pair.server(), "10.0.0.7", 1);
  ASSERT_TRUE(connections.begin_answer(connection, nullptr));
  bool may_go_on = true;
  Response response = file_of(1);
  response.may_go_on = [&may_go_on] { return may_go_on; };
  connections.begin_sending(connection, response);
  const hal::TimePoint now = connection->deadline - seconds(1);
  EXPECT_EQ(connections.end_overdue(now), 0U);
  EXPECT_FALSE(pair.is_shut());
  may_go_on = false;
  EXPECT_EQ(connections.end_overdue(now), 0U) << "its client is not slow";
  EXPECT_TRUE(pair.is_shut());
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
    connections.begin_sending(connection, {});
    is_sent = true;
    connections.end_answer(connection);
  });
  connections.end_all();
  EXPECT_TRUE(is_sent);
}

}  // namespace
}  // namespace orbwatch::app::web
