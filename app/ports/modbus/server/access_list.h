// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <netinet/in.h>
#include <sys/socket.h>

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "hal/network.h"
#include "proc/image/result.h"

/// Addresses and permissions of clients.
namespace orbwatch::app::modbus {

using hal::HostAddress;
using hal::Network;
using hal::parse_network;
using hal::text_of;

/// An address of a socket in the form of system calls.
struct SocketAddress {
  sockaddr_storage storage{};
  socklen_t length = sizeof(sockaddr_storage);

  sockaddr* get() { return reinterpret_cast<sockaddr*>(&storage); }
  const sockaddr* get() const { return reinterpret_cast<const sockaddr*>(&storage); }
};

/// Parses a numeric IPv4 or IPv6 address; never waits for a name server. Reentrant.
std::optional<SocketAddress> parse_address(const std::string& text, int port);

/// The host and the port of an IPv4 or IPv6 address. Reentrant.
HostAddress host_of(const SocketAddress& address);
int port_of(const SocketAddress& address);

/// Permission of a client. None: connections are refused. Write includes reading.
enum class Permission : std::uint8_t { None, Read, Write };

/// The permissions of clients by their address: Modbus has no authentication. Immutable; reentrant.
class AccessList {
 public:
  /// Permits all clients to read, and the server's own host to write.
  AccessList() = default;

  /// Networks as for hal::parse_network. No readers: all clients may read. Writers may read. No
  /// writers: readers on the server's own host may write.
  static Result<AccessList> create(const std::vector<std::string>& readers,
                                   const std::vector<std::string>& writers);

  /// `server`: the address by which the client reached the server.
  Permission of(const HostAddress& client, const HostAddress& server) const;

 private:
  std::vector<Network> readers_;
  std::vector<Network> writers_;
};

}  // namespace orbwatch::app::modbus
