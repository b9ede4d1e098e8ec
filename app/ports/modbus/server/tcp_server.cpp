// SPDX-License-Identifier: Apache-2.0
#include "app/ports/modbus/server/tcp_server.h"

#include <netinet/in.h>
#include <netinet/tcp.h>
#include <sys/epoll.h>
#include <sys/socket.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <string>
#include <system_error>
#include <tuple>
#include <utility>

#include "hal/socket_address.h"

namespace orbwatch::app::modbus {
namespace {

// User data of epoll events. Connections have their own identifiers, because the kernel reuses
// socket numbers and a later event of the same round may still belong to the closed socket.
constexpr std::uint64_t kStop = 0;
constexpr std::uint64_t kListener = 1;
constexpr std::uint64_t kFirstConnection = 2;

/// Limits unread answers of one client; the kernel doubles it for its bookkeeping.
constexpr int kSendBuffer = 16384;

/// TCP keep-alive: interval of probes, s, and number of unanswered probes that end a connection.
constexpr int kProbePeriod = 10;
constexpr int kProbes = 3;

/// Pause after the process ran out of file descriptors.
constexpr std::chrono::seconds kAcceptPause{1};

std::string text_of(int error) { return std::system_category().message(error); }

std::string advice(int error) {
  switch (error) {
    case EADDRINUSE:
      return "stop the program that uses it or set another port";
    case EACCES:
      return "ports below 1024 need CAP_NET_BIND_SERVICE, 1502 does not";
    case EADDRNOTAVAIL:
      return "set an address of this machine, or 0.0.0.0 for all of them";
    default:
      return "check address and port";
  }
}

Result<> check(const ModbusSettings& settings) {
  if (settings.port < 0 || settings.port > 65535) {
    return fail("modbus: port " + std::to_string(settings.port) + " must be 0 to 65535");
  }
  if (settings.max_connections < 1) {
    return fail("modbus: max_connections " + std::to_string(settings.max_connections) +
                " admits no client; set 1 or more");
  }
  return {};
}

/// Address by which the client of an accepted socket reached this host; unspecified if the client
/// has disconnected.
HostAddress server_host(int socket) {
  hal::SocketAddress address;
  return ::getsockname(socket, address.get(), &address.length) == 0 ? address.host()
                                                                    : HostAddress{};
}

int watch_file(int epoll, int operation, int file, std::uint64_t id, std::uint32_t events) {
  epoll_event event{};
  event.events = events;
  event.data.u64 = id;
  return ::epoll_ctl(epoll, operation, file, &event);
}

}  // namespace

Result<std::unique_ptr<TcpServer>> TcpServer::open(const ModbusSettings& settings, Answer answer,
                                                   ServerCounters& counters) {
  if (auto checked = check(settings); !checked) return tl::unexpected(checked.error());
  std::unique_ptr<TcpServer> server(new TcpServer(settings, std::move(answer), counters));
  auto access = AccessList::create(settings.readers, settings.writers);
  if (!access) return tl::unexpected(access.error());
  server->access_ = std::move(*access);
  if (auto listening = server->listen(); !listening) return tl::unexpected(listening.error());
  if (auto watching = server->watch(); !watching) return tl::unexpected(watching.error());
  return server;
}

Result<> TcpServer::listen() {
  auto address = hal::parse_address(settings_.address, settings_.port);
  if (!address) {
    return fail("modbus: address '" + settings_.address +
                "' is not a numeric IP address, or its network interface is absent; set one of "
                "this machine, or 0.0.0.0 for all");
  }
  const auto refused = [this] {
    const int error = errno;
    return fail("modbus: cannot listen on " + settings_.address + " port " +
                std::to_string(settings_.port) + ": " + text_of(error) + "; " + advice(error));
  };
  listener_ = hal::FileDescriptor(
      ::socket(address->family(), SOCK_STREAM | SOCK_NONBLOCK | SOCK_CLOEXEC, 0));
  if (!listener_.is_open()) return refused();
  // Needed so that a restart does not wait for connections of the previous run to time out.
  const int on = 1;
  if (::setsockopt(listener_.get(), SOL_SOCKET, SO_REUSEADDR, &on, sizeof(on)) != 0 ||
      ::bind(listener_.get(), address->get(), address->length) != 0 ||
      ::listen(listener_.get(), SOMAXCONN) != 0 ||
      ::getsockname(listener_.get(), address->get(), &address->length) != 0) {
    return refused();
  }
  port_ = address->port();
  return {};
}

Result<> TcpServer::watch() {
  epoll_ = hal::FileDescriptor(::epoll_create1(EPOLL_CLOEXEC));
  if (!epoll_.is_open() || !stop_.is_open() ||
      watch_file(epoll_.get(), EPOLL_CTL_ADD, stop_.get(), kStop, EPOLLIN) != 0 ||
      watch_file(epoll_.get(), EPOLL_CTL_ADD, listener_.get(), kListener, EPOLLIN) != 0) {
    return fail("modbus: cannot watch the sockets: " + text_of(errno));
  }
  next_id_ = kFirstConnection;
  connections_.reserve(static_cast<std::size_t>(settings_.max_connections));
  return {};
}

void TcpServer::run() {
  std::array<epoll_event, 32> events;
  for (;;) {
    const int count = ::epoll_wait(epoll_.get(), events.data(), static_cast<int>(events.size()),
                                   hal::poll_timeout(next_deadline()));
    for (int i = 0; i < count; ++i) {
      const std::uint64_t id = events[static_cast<std::size_t>(i)].data.u64;
      if (id == kStop) return;
      if (id == kListener) {
        accept_client();
      } else {
        serve(id);
      }
    }
    drop_overdue();
    publish_clients();
    if (!accepting_ && hal::Clock::now() >= accept_again_) {
      accepting_ =
          watch_file(epoll_.get(), EPOLL_CTL_MOD, listener_.get(), kListener, EPOLLIN) == 0;
    }
  }
}

/// Accepts one client per round, so that a flood of connections does not delay served clients.
void TcpServer::accept_client() {
  hal::SocketAddress peer;
  hal::FileDescriptor socket(
      ::accept4(listener_.get(), peer.get(), &peer.length, SOCK_NONBLOCK | SOCK_CLOEXEC));
  if (!socket.is_open()) {
    // Other errors mean that this client has disconnected.
    if (errno == EMFILE || errno == ENFILE || errno == ENOBUFS || errno == ENOMEM) {
      pause_accepting();
    }
    return;
  }
  const HostAddress host = peer.host();
  const Permission permission = access_.of(host, server_host(socket.get()));
  if (permission == Permission::None || !has_room_for(permission)) {
    ++counters_.dropped;
    return;
  }
  const std::uint64_t id = next_id_++;
  if (!set_up(socket.get()) ||
      watch_file(epoll_.get(), EPOLL_CTL_ADD, socket.get(), id, EPOLLIN) != 0) {
    ++counters_.dropped;
    return;
  }
  connections_.push_back({.id = id,
                          .socket = std::move(socket),
                          .host = host,
                          .may_write = permission == Permission::Write,
                          .last_request = hal::Clock::now()});
  counters_.connections = connections_.size();
}

/// Sets keep-alive and the timeout of answers, which detect a client whose computer was switched
/// off or whose cable was pulled.
bool TcpServer::set_up(int socket) const {
  const auto set = [socket](int level, int option, int value) {
    return ::setsockopt(socket, level, option, &value, sizeof(value)) == 0;
  };
  const auto lost_after = std::chrono::seconds(settings_.keep_alive_s + kProbes * kProbePeriod);
  return set(IPPROTO_TCP, TCP_NODELAY, 1) && set(SOL_SOCKET, SO_SNDBUF, kSendBuffer) &&
         set(SOL_SOCKET, SO_KEEPALIVE, 1) &&
         set(IPPROTO_TCP, TCP_KEEPIDLE, settings_.keep_alive_s) &&
         set(IPPROTO_TCP, TCP_KEEPINTVL, kProbePeriod) && set(IPPROTO_TCP, TCP_KEEPCNT, kProbes) &&
         set(IPPROTO_TCP, TCP_USER_TIMEOUT,
             static_cast<int>(std::chrono::milliseconds(lost_after).count()));
}

/// Stops listening for events, because the client in the backlog would wake epoll until a
/// descriptor is free.
void TcpServer::pause_accepting() {
  accepting_ = watch_file(epoll_.get(), EPOLL_CTL_MOD, listener_.get(), kListener, 0) != 0;
  accept_again_ = hal::Clock::now() + kAcceptPause;
}

/// Makes room in a full server by closing the oldest unused connection (Modbus Messaging on TCP/IP
/// Implementation Guide): readers before writers, then connections without a request, then those of
/// the host with most connections. So neither readers nor many connections can displace a PLC. A
/// reader displaces only an idle writer.
bool TcpServer::has_room_for(Permission permission) {
  if (connections_.size() < static_cast<std::size_t>(settings_.max_connections)) return true;
  const auto idle_since = hal::Clock::now() - settings_.idle_time;
  const auto rank = [&](const Connection& connection) {
    const bool is_protected = permission != Permission::Write && connection.may_write &&
                              connection.last_request > idle_since;
    const auto of_host = std::ranges::count(connections_, connection.host, &Connection::host);
    return std::tuple(is_protected, connection.may_write, connection.requests > 0, -of_host,
                      connection.last_request);
  };
  const auto least = std::ranges::min_element(connections_, {}, rank);
  if (std::get<0>(rank(*least))) return false;
  ++counters_.dropped;
  drop(least);
  return true;
}

void TcpServer::serve(std::uint64_t id) {
  const auto connection = std::ranges::find(connections_, id, &Connection::id);
  if (connection == connections_.end()) return;  // closed in this round
  const auto room = connection->framer.room();
  const ssize_t received = ::recv(connection->socket.get(), room.data(), room.size(), 0);
  if (received < 0 && (errno == EAGAIN || errno == EINTR)) return;
  if (received <= 0) return drop(connection);  // the client disconnected
  if (connection->framer.is_empty()) connection->frame_begin = hal::Clock::now();
  connection->framer.commit(static_cast<std::size_t>(received));
  if (answer_frames(*connection)) return;
  ++counters_.dropped;
  drop(connection);
}

/// Answers the complete frames received; false: the connection must be closed.
bool TcpServer::answer_frames(Connection& connection) {
  const std::uint64_t before = connection.requests;
  while (const auto frame = connection.framer.next()) {
    const Outcome outcome = answer_(connection.socket.get(), *frame, connection.may_write);
    if (outcome != Outcome::Answered && outcome != Outcome::NotSent) ++counters_.refused;
    if (outcome == Outcome::NotModbus || outcome == Outcome::NotSent) return false;
    ++counters_.answered;
    ++connection.requests;
  }
  if (connection.framer.is_broken()) {
    ++counters_.refused;
    return false;
  }
  if (connection.requests != before) {
    connection.last_request = connection.frame_begin = hal::Clock::now();
  }
  return true;
}

void TcpServer::drop(Connections::iterator connection) {
  connections_.erase(connection);  // closes the socket, which removes it from epoll
  counters_.connections = connections_.size();
}

void TcpServer::publish_clients() {
  const std::lock_guard lock(clients_mutex_);
  clients_.clear();
  for (const Connection& connection : connections_) {
    clients_.push_back(
        {connection.host, connection.may_write, connection.requests, connection.last_request});
  }
}

std::vector<TcpServer::Client> TcpServer::clients() const {
  const std::lock_guard lock(clients_mutex_);
  return clients_;
}

hal::TimePoint TcpServer::deadline(const Connection& connection) const {
  return connection.framer.is_empty() ? hal::TimePoint::max()
                                      : connection.frame_begin + settings_.frame_timeout;
}

void TcpServer::drop_overdue() {
  const auto now = hal::Clock::now();
  const auto overdue = [&](const Connection& connection) { return deadline(connection) <= now; };
  counters_.dropped += std::erase_if(connections_, overdue);
  counters_.connections = connections_.size();
}

/// Earliest deadline of a connection or of accepting.
hal::TimePoint TcpServer::next_deadline() const {
  auto next = accepting_ ? hal::TimePoint::max() : accept_again_;
  for (const Connection& connection : connections_) next = std::min(next, deadline(connection));
  return next;
}

}  // namespace orbwatch::app::modbus
