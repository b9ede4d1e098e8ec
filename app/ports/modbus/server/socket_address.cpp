#include "app/ports/modbus/server/socket_address.h"

#include <arpa/inet.h>

#include <algorithm>
#include <cstring>

namespace orbwatch::app::modbus {

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
  // sin_port and sin6_port stand in the same place.
  sockaddr_in v4{};
  std::memcpy(&v4, &address.storage, sizeof(v4));
  return ntohs(v4.sin_port);
}

}  // namespace orbwatch::app::modbus
