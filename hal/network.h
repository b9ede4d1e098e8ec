// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "proc/image/result.h"

/// Numeric addresses of hosts, and networks of them. All reentrant; none waits for a name server.
namespace orbwatch::hal {

/// The address of a host: IPv6, or IPv4 mapped into it (::ffff:a.b.c.d).
using HostAddress = std::array<std::uint8_t, 16>;

/// The address 0.0.0.0, mapped. Every IPv4 address differs from it only from byte kV4Begin on.
inline constexpr HostAddress kAnyV4{0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0xff, 0xff};
inline constexpr std::size_t kV4Begin = 12;

/// Parses a numeric IPv4 or IPv6 address: 10.0.0.7, fd00::1.
std::optional<HostAddress> parse_host(const std::string& text);

/// Numeric text of an address: 10.0.0.7, fd00::1.
std::string text_of(const HostAddress& host);

bool is_v4(const HostAddress& host);

/// True for 127.0.0.0/8 and ::1.
bool is_loopback(const HostAddress& host);
/// The same for a numeric text; false for any other text.
bool is_loopback(const std::string& text);

/// One host, or all hosts of a CIDR prefix (RFC 4632, RFC 4291).
struct Network {
  HostAddress address{};
  int prefix_length = 128;  ///< counted in bits of the IPv6 form

  bool contains(const HostAddress& host) const;
};

/// Parses a numeric address or a prefix: 10.0.0.7, 10.0.0.0/24, fd00::/8. Errors: neither, or bits
/// set after the prefix, as in a host's address.
Result<Network> parse_network(const std::string& text);

/// Parses a list; the error is that of its first wrong text.
Result<std::vector<Network>> parse_networks(const std::vector<std::string>& texts);

/// True if it contains every IPv4 or every IPv6 address.
bool is_everybody(const Network& network);

bool any_contains(const std::vector<Network>& networks, const HostAddress& host);

/// Declares for a settings' visitor that every text of a key must be an address or a prefix.
template <class Visitor>
void require_networks(Visitor& v, const char* key, const std::vector<std::string>& texts) {
  for (const std::string& text : texts) {
    const auto network = parse_network(text);
    v.require(network.has_value(), key, network ? "" : network.error().message);
  }
}

}  // namespace orbwatch::hal
