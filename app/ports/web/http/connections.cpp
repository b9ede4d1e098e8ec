// SPDX-License-Identifier: Apache-2.0
#include "app/ports/web/http/connections.h"

#include <poll.h>
#include <sys/socket.h>

#include <algorithm>
#include <utility>

#include "app/ports/web/http/address.h"
#include "hal/acknowledged_bytes.h"

namespace orbwatch::app::web {
namespace {

bool has_gone(int socket) {
  pollfd poll{socket, POLLRDHUP, 0};
  return ::poll(&poll, 1, 0) > 0;
}

/// Connections to end once no lock is held.
struct Ends {
  std::vector<ExchangePtr> exchanges;
  std::vector<std::shared_ptr<StreamSender>> streams;

  void add(const Connections::Connection& connection) {
    if (auto exchange = connection.exchange.lock()) exchanges.push_back(std::move(exchange));
    if (auto stream = connection.stream.lock()) {
      // safe under the lock: the socket is still this connection's
      ::shutdown(connection.socket, SHUT_RDWR);
      streams.push_back(std::move(stream));
    }
  }
  void end() {
    for (const auto& exchange : exchanges) exchange->give_up(no_answer());
    for (const auto& stream : streams) stream->end();
  }
  static Response no_answer() { return error_response(503, "the answer timed out"); }
};

}  // namespace

Connections::Connection* Connections::add(int socket, std::string peer, std::size_t most) {
  std::string key = address_key(peer);
  const std::lock_guard lock(mutex_);
  const auto open_ones = std::ranges::count_if(
      all_, [&](const Connection& one) { return one.key == key && !one.is_beyond; });
  Connection& added = all_.emplace_back();
  added.socket = socket;
  added.peer = std::move(peer);
  added.key = std::move(key);
  added.is_beyond = static_cast<std::size_t>(open_ones) >= most;
  added.deadline = added.is_beyond ? hal::TimePoint::max() : hal::Clock::now() + timeout_;
  if (added.is_beyond) ::shutdown(socket, SHUT_RDWR);
  return &added;
}

void Connections::remove(Connection* connection) {
  const std::lock_guard lock(mutex_);
  all_.remove_if([connection](const Connection& one) { return &one == connection; });
  sent_.notify_all();
}

bool Connections::count_for(Connection* connection, const std::string& client, std::size_t most) {
  std::string key = address_key(client);
  const std::lock_guard lock(mutex_);
  connection->client.clear();
  const auto others = std::ranges::count_if(all_, [&](const Connection& one) {
    return &one != connection && !one.is_beyond &&
           (one.client.empty() ? one.key == key : one.client == key);
  });
  if (static_cast<std::size_t>(others) >= most) return false;
  connection->client = std::move(key);
  return true;
}

bool Connections::begin_answer(Connection* connection, const ExchangePtr& exchange) {
  const std::lock_guard lock(mutex_);
  connection->deadline = hal::Clock::now() + timeout_;
  connection->exchange = exchange;
  connection->is_answering = true;
  return !is_closing_ && !connection->is_beyond;
}

void Connections::begin_sending(Connection* connection, const Response& response) {
  const std::lock_guard lock(mutex_);
  connection->exchange.reset();
  connection->is_sending = true;
  connection->read = hal::acknowledged_bytes(connection->socket);
  connection->deadline = hal::Clock::now() + timeout_;
  connection->latest_deadline = hal::TimePoint::max();
  if (!response.file) return;
  const auto seconds = static_cast<std::int64_t>(response.file->size / kLeastRate);
  connection->latest_deadline = connection->deadline + std::chrono::seconds(seconds);
  connection->may_go_on = response.may_go_on;
}

bool Connections::begin_stream(Connection* connection, const std::shared_ptr<StreamSender>& stream,
                               std::function<bool()> may_go_on) {
  const std::lock_guard lock(mutex_);
  connection->may_go_on = std::move(may_go_on);
  connection->exchange.reset();
  connection->is_answering = false;
  connection->stream = stream;
  connection->deadline = hal::TimePoint::max();
  return !is_closing_;
}

void Connections::end_answer(Connection* connection) {
  const std::lock_guard lock(mutex_);
  connection->client.clear();
  connection->exchange.reset();
  connection->stream.reset();
  connection->may_go_on = nullptr;
  connection->deadline = hal::Clock::now() + timeout_;
  connection->is_answering = connection->is_sending = false;
  sent_.notify_all();
}

/// True: the client reads its answer fast enough to go on. mutex_ is held.
bool Connections::gets_another_term(Connection& connection, hal::TimePoint now) const {
  if (!connection.is_sending || now >= connection.latest_deadline) return false;
  const std::uint64_t read = hal::acknowledged_bytes(connection.socket);
  if (read < connection.read + kLeastProgress) return false;
  connection.read = read;
  connection.deadline = std::min<hal::TimePoint>(now + timeout_, connection.latest_deadline);
  return true;
}

std::size_t Connections::end_overdue(hal::TimePoint now) {
  Ends ends;
  std::size_t overdue = 0;
  {
    const std::lock_guard lock(mutex_);
    for (Connection& connection : all_) {
      const bool is_overdue = now >= connection.deadline && !gets_another_term(connection, now);
      const bool may_go_on = !connection.may_go_on || connection.may_go_on();
      const bool gone = has_gone(connection.socket);
      const bool had_gone = std::exchange(connection.has_gone, gone);
      if (!is_overdue && may_go_on && !gone) continue;
      if (is_overdue) {
        ++overdue;
        // so that it is counted once, however late it is removed
        connection.deadline = hal::TimePoint::max();
      }
      const bool waits_for_answer = !connection.exchange.expired();
      const bool asks_nothing = gone && had_gone && !connection.is_answering;
      ends.add(connection);
      if ((is_overdue && !waits_for_answer) || !may_go_on || asks_nothing) {
        ::shutdown(connection.socket, SHUT_RDWR);
      }
    }
  }
  ends.end();
  return overdue;
}

void Connections::end_all() {
  Ends ends;
  {
    const std::lock_guard lock(mutex_);
    is_closing_ = true;
    for (const Connection& connection : all_) ends.add(connection);
  }
  ends.end();
  std::vector<ExchangePtr> unanswered;
  {
    std::unique_lock lock(mutex_);
    sent_.wait_for(lock, kLongestFlush,
                   [this] { return std::ranges::none_of(all_, &Connection::is_answering); });
    for (const Connection& connection : all_) {
      if (auto exchange = connection.exchange.lock()) unanswered.push_back(std::move(exchange));
    }
  }
  // The library cannot stop while a connection is suspended.
  for (const auto& exchange : unanswered) exchange->answer(Ends::no_answer());
}

}  // namespace orbwatch::app::web
