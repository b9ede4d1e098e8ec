// SPDX-License-Identifier: Apache-2.0
#include "tests/support/raw_client.h"

#include <arpa/inet.h>
#include <netinet/tcp.h>
#include <poll.h>
#include <sys/socket.h>

#include <array>
#include <cerrno>
#include <chrono>
#include <stdexcept>

#include "tests/support/require.h"

namespace orbwatch::tests {
namespace {

constexpr std::chrono::seconds kGuard{60};

sockaddr_in loopback_address(const std::string& host, int port) {
  sockaddr_in address{};
  address.sin_family = AF_INET;
  address.sin_port = htons(static_cast<std::uint16_t>(port));
  if (::inet_pton(AF_INET, host.c_str(), &address.sin_addr) != 1) {
    throw std::invalid_argument(host);
  }
  return address;
}

}  // namespace

RawClient::RawClient(Unconnected) : socket_(::socket(AF_INET, SOCK_STREAM | SOCK_CLOEXEC, 0)) {
  const timeval guard{kGuard.count(), 0};
  const int on = 1;
  require(::setsockopt(socket_.get(), SOL_SOCKET, SO_RCVTIMEO, &guard, sizeof(guard)) == 0 &&
          ::setsockopt(socket_.get(), IPPROTO_TCP, TCP_NODELAY, &on, sizeof(on)) == 0);
}

RawClient::RawClient(int port, const std::string& from, int receive_buffer)
    : RawClient(Unconnected{}) {
  if (receive_buffer > 0) {
    require(::setsockopt(socket_.get(), SOL_SOCKET, SO_RCVBUF, &receive_buffer,
                         sizeof(receive_buffer)) == 0);
  }
  const auto own = loopback_address(from, 0);
  require(::bind(socket_.get(), reinterpret_cast<const sockaddr*>(&own), sizeof(own)) == 0);
  connect(port);
}

void RawClient::connect(int port) {
  const auto server = loopback_address("127.0.0.1", port);
  require(::connect(socket_.get(), reinterpret_cast<const sockaddr*>(&server), sizeof(server)) ==
          0);
}

bool RawClient::send(const Bytes& bytes) {
  const auto sent = ::send(socket_.get(), bytes.data(), bytes.size(), MSG_NOSIGNAL);
  return sent == static_cast<ssize_t>(bytes.size());
}

long RawClient::send_some(const Bytes& bytes) {
  const auto sent = ::send(socket_.get(), bytes.data(), bytes.size(), MSG_NOSIGNAL | MSG_DONTWAIT);
  return sent < 0 && errno == EAGAIN ? 0 : sent;
}

long RawClient::discard() {
  std::array<std::uint8_t, 4096> bytes;
  for (long count = 0;;) {
    const auto got = ::recv(socket_.get(), bytes.data(), bytes.size(), MSG_DONTWAIT);
    if (got <= 0) return got < 0 && errno == EAGAIN ? count : -1;
    count += got;
  }
}

void RawClient::wait_writable() {
  pollfd file{socket_.get(), POLLOUT, 0};
  ::poll(&file, 1, static_cast<int>(std::chrono::milliseconds(kGuard).count()));
}

Bytes RawClient::receive(std::size_t count) {
  Bytes bytes(count);
  const auto got = ::recv(socket_.get(), bytes.data(), count, MSG_WAITALL);
  bytes.resize(got > 0 ? static_cast<std::size_t>(got) : 0);
  return bytes;
}

bool RawClient::is_closed_by_server() {
  std::uint8_t byte = 0;
  const auto got = ::recv(socket_.get(), &byte, 1, 0);
  return got == 0 || (got < 0 && errno == ECONNRESET);
}

void RawClient::finish_sending() { ::shutdown(socket_.get(), SHUT_WR); }

}  // namespace orbwatch::tests
