#pragma once

#include <netinet/in.h>
#include <sys/socket.h>

#include <array>
#include <cstdint>
#include <optional>
#include <string>

namespace orbwatch::app::modbus {

/// An address of a socket in the form of system calls.
struct SocketAddress {
  sockaddr_storage storage{};
  socklen_t length = sizeof(sockaddr_storage);

  sockaddr* get() { return reinterpret_cast<sockaddr*>(&storage); }
  const sockaddr* get() const { return reinterpret_cast<const sockaddr*>(&storage); }
};

/// The address of a host: IPv6, or IPv4 mapped into it (::ffff:a.b.c.d).
using HostAddress = std::array<std::uint8_t, 16>;

/// Parses a numeric IPv4 or IPv6 address; never waits for a name server. Reentrant.
std::optional<SocketAddress> parse_address(const std::string& text, int port);

/// The host and the port of an IPv4 or IPv6 address. Reentrant.
HostAddress host_of(const SocketAddress& address);
int port_of(const SocketAddress& address);

}  // namespace orbwatch::app::modbus
