// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <sys/socket.h>

#include <optional>
#include <string>
#include <string_view>
#include <vector>

/// Addresses and names of hosts. All reentrant; none waits for a name server.
namespace orbwatch::app::web {

/// An address of a socket in the form of system calls.
struct SocketAddress {
  sockaddr_storage storage{};
  socklen_t length = sizeof(sockaddr_storage);

  sockaddr* get() { return reinterpret_cast<sockaddr*>(&storage); }
  const sockaddr* get() const { return reinterpret_cast<const sockaddr*>(&storage); }
};

/// Parses a numeric IPv4 or IPv6 address.
std::optional<SocketAddress> parse_address(const std::string& text, int port);

/// Numeric text of an address, with an IPv4 address mapped into IPv6 (::ffff:a.b.c.d) as IPv4:
/// 10.0.0.7, fd00::1. Empty for other families.
std::string host_text(const sockaddr* address);

/// Returns whether `host` is a numeric loopback address: 127.0.0.0/8 or ::1.
bool is_loopback(const std::string& host);

/// Key for counting an address; an IPv6 address counts as its /64 network, because one host may use
/// every address of it.
std::string address_key(const std::string& peer);

/// The host of a Host header (RFC 9110, 7.2) as written, without a port; nullopt: malformed.
std::optional<std::string_view> host_in(std::string_view header);

bool equal_in_any_case(std::string_view a, std::string_view b);

/// Returns whether a Host header (RFC 9110, 7.2) names this appliance: a numeric address, localhost
/// or one of `names`, in any case, with or without a port and the root's dot at a name's end.
bool is_own_host(std::string_view header, const std::vector<std::string>& names);

}  // namespace orbwatch::app::web
