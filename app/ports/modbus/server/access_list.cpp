// SPDX-License-Identifier: Apache-2.0
#include "app/ports/modbus/server/access_list.h"

#include <arpa/inet.h>

#include <cstring>
#include <utility>

namespace orbwatch::app::modbus {
namespace {

/// Returns whether the client is on the server's host: packets from other hosts have neither its
/// address nor a loopback address as their source.
bool is_same_host(const HostAddress& client, const HostAddress& server) {
  static const std::vector<Network> kLoopback{parse_network("127.0.0.0/8").value(),
                                              parse_network("::1").value()};
  return client == server || hal::any_contains(kLoopback, client);
}

}  // namespace

std::optional<SocketAddress> parse_address(const std::string& text, int port) {
  SocketAddress address;
  sockaddr_in v4{};
  if (::inet_pton(AF_INET, text.c_str(), &v4.sin_addr) == 1) {
    v4.sin_family = AF_INET;
    v4.sin_port = htons(static_cast<std::uint16_t>(port));
    std::memcpy(&address.storage, &v4, sizeof(v4));
    address.length = sizeof(v4);
    return address;
  }
  sockaddr_in6 v6{};
  if (::inet_pton(AF_INET6, text.c_str(), &v6.sin6_addr) == 1) {
    v6.sin6_family = AF_INET6;
    v6.sin6_port = htons(static_cast<std::uint16_t>(port));
    std::memcpy(&address.storage, &v6, sizeof(v6));
    address.length = sizeof(v6);
    return address;
  }
  return std::nullopt;
}

HostAddress host_of(const SocketAddress& address) {
  HostAddress host{};
  if (address.storage.ss_family == AF_INET) {
    sockaddr_in v4{};
    std::memcpy(&v4, &address.storage, sizeof(v4));
    host[10] = host[11] = 0xff;
    std::memcpy(&host[12], &v4.sin_addr, 4);
  } else {
    sockaddr_in6 v6{};
    std::memcpy(&v6, &address.storage, sizeof(v6));
    std::memcpy(host.data(), &v6.sin6_addr, host.size());
  }
  return host;
}

int port_of(const SocketAddress& address) {
  // sin_port and sin6_port have the same offset.
  sockaddr_in v4{};
  std::memcpy(&v4, &address.storage, sizeof(v4));
  return ntohs(v4.sin_port);
}

Result<AccessList> AccessList::create(const std::vector<std::string>& readers,
                                      const std::vector<std::string>& writers) {
  auto may_read = hal::parse_networks(readers);
  if (!may_read) return fail("modbus: readers: " + may_read.error().message);
  auto may_write = hal::parse_networks(writers);
  if (!may_write) return fail("modbus: writers: " + may_write.error().message);
  AccessList list;
  list.readers_ = std::move(*may_read);
  list.writers_ = std::move(*may_write);
  return list;
}

Permission AccessList::of(const HostAddress& client, const HostAddress& server) const {
  const bool is_reader = readers_.empty() || hal::any_contains(readers_, client);
  const bool is_writer = writers_.empty() ? is_reader && is_same_host(client, server)
                                          : hal::any_contains(writers_, client);
  if (is_writer) return Permission::Write;
  return is_reader ? Permission::Read : Permission::None;
}

}  // namespace orbwatch::app::modbus
