// SPDX-License-Identifier: Apache-2.0
#include "hal/socket_address.h"

#include <net/if.h>
#include <netinet/in.h>

#include <algorithm>
#include <cstring>

namespace orbwatch::hal {
namespace {

template <class Address>
Address read(const SocketAddress& from) {
  Address address{};
  std::memcpy(&address, &from.storage, sizeof(address));
  return address;
}

template <class Address>
void write(const Address& address, SocketAddress& to) {
  std::memcpy(&to.storage, &address, sizeof(address));
  to.length = sizeof(address);
}

}  // namespace

SocketAddress::SocketAddress(const HostAddress& host, int port) {
  const in_port_t number = htons(static_cast<std::uint16_t>(port));
  if (is_v4(host)) {
    sockaddr_in v4{};
    v4.sin_family = AF_INET;
    v4.sin_port = number;
    std::memcpy(&v4.sin_addr, &host[kV4Begin], sizeof(v4.sin_addr));
    write(v4, *this);
  } else {
    sockaddr_in6 v6{};
    v6.sin6_family = AF_INET6;
    v6.sin6_port = number;
    std::ranges::copy(host, v6.sin6_addr.s6_addr);
    write(v6, *this);
  }
}

SocketAddress::SocketAddress(const sockaddr* address) {
  const int given = address->sa_family;
  if (given != AF_INET && given != AF_INET6) return;
  length = given == AF_INET ? sizeof(sockaddr_in) : sizeof(sockaddr_in6);
  std::memcpy(&storage, address, length);
}

HostAddress SocketAddress::host() const {
  if (family() == AF_INET6) return std::to_array(read<sockaddr_in6>(*this).sin6_addr.s6_addr);
  HostAddress host{};
  if (family() == AF_INET) {
    const auto v4 = read<sockaddr_in>(*this);
    host = kAnyV4;
    std::memcpy(&host[kV4Begin], &v4.sin_addr, sizeof(v4.sin_addr));
  }
  return host;
}

int SocketAddress::port() const {
  // sin_port and sin6_port have the same offset.
  return ntohs(read<sockaddr_in>(*this).sin_port);
}

std::optional<SocketAddress> parse_address(const std::string& text, int port) {
  const std::size_t percent = text.find('%');
  const auto host = parse_host(text.substr(0, percent));
  if (!host) return std::nullopt;
  SocketAddress address(*host, port);
  if (percent == text.npos) return address;
  auto v6 = read<sockaddr_in6>(address);
  v6.sin6_scope_id = ::if_nametoindex(text.c_str() + percent + 1);
  if (v6.sin6_family != AF_INET6 || v6.sin6_scope_id == 0) return std::nullopt;
  write(v6, address);
  return address;
}

}  // namespace orbwatch::hal
