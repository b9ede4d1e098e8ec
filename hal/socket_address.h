// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <sys/socket.h>

#include <optional>
#include <string>

#include "hal/network.h"

namespace orbwatch::hal {

/// An IPv4 or IPv6 address of a socket, in the form of system calls. Reentrant.
struct SocketAddress {
  sockaddr_storage storage{};
  socklen_t length = sizeof(sockaddr_storage);

  /// An address without a family, with room for the one that a system call writes.
  SocketAddress() = default;
  /// A host's address; one that is mapped into IPv6 becomes IPv4.
  SocketAddress(const HostAddress& host, int port);
  /// A copy of an address of either family; one of another family stays empty.
  explicit SocketAddress(const sockaddr* address);

  sockaddr* get() { return reinterpret_cast<sockaddr*>(&storage); }
  const sockaddr* get() const { return reinterpret_cast<const sockaddr*>(&storage); }

  int family() const { return storage.ss_family; }
  /// The unspecified address (::) and port 0 without a family.
  HostAddress host() const;
  int port() const;
};

/// Parses a numeric address, of IPv6 with or without a zone (RFC 4007, 11): 10.0.0.7, fd00::1,
/// fe80::1%eth0. Nullopt: neither, or no such zone. Never waits for a name server.
std::optional<SocketAddress> parse_address(const std::string& text, int port);

}  // namespace orbwatch::hal
