#include "app/ports/modbus/server/access_list.h"

#include <arpa/inet.h>

#include <algorithm>
#include <charconv>
#include <cstring>
#include <string_view>

namespace orbwatch::app::modbus {
namespace {

constexpr int kAddressBits = 128;
constexpr int kMappedBits = 96;  // before an IPv4 address in an IPv6 one

/// `bits` leading ones of the byte at `place` of an address.
std::uint8_t mask_of(int prefix_length, std::size_t place) {
  const int bits = std::clamp(prefix_length - 8 * static_cast<int>(place), 0, 8);
  return static_cast<std::uint8_t>(0xff00 >> bits);
}

/// A whole number and nothing else.
std::optional<int> number_in(std::string_view text) {
  int number = 0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), number);
  if (error != std::errc() || end != text.data() + text.size()) return std::nullopt;
  return number;
}

Result<std::vector<Network>> parse_networks(const std::vector<std::string>& texts) {
  std::vector<Network> networks;
  for (const std::string& text : texts) {
    const auto network = parse_network(text);
    if (!network) return tl::unexpected(network.error());
    networks.push_back(*network);
  }
  return networks;
}

bool any_contains(const std::vector<Network>& networks, const HostAddress& host) {
  return std::ranges::any_of(networks,
                             [&](const Network& network) { return network.contains(host); });
}

/// No packet from another host has such a client address.
bool is_same_host(const HostAddress& client, const HostAddress& server) {
  static const std::vector<Network> kLoopback{parse_network("127.0.0.0/8").value(),
                                              parse_network("::1").value()};
  return client == server || any_contains(kLoopback, client);
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

std::string text_of(const HostAddress& host) {
  static const Network kMapped{parse_network("::ffff:0:0/96").value()};
  std::array<char, INET6_ADDRSTRLEN> text{};
  const bool is_v4 = kMapped.contains(host);
  ::inet_ntop(is_v4 ? AF_INET : AF_INET6, host.data() + (is_v4 ? kMappedBits / 8 : 0), text.data(),
              text.size());
  return text.data();
}

int port_of(const SocketAddress& address) {
  // sin_port and sin6_port stand in the same place.
  sockaddr_in v4{};
  std::memcpy(&v4, &address.storage, sizeof(v4));
  return ntohs(v4.sin_port);
}

bool Network::contains(const HostAddress& host) const {
  for (std::size_t i = 0; i < host.size(); ++i) {
    if ((host[i] ^ address[i]) & mask_of(prefix_length, i)) return false;
  }
  return true;
}

Result<Network> parse_network(const std::string& text) {
  const std::size_t slash = text.find('/');
  const auto address = parse_address(text.substr(0, slash), 0);
  if (!address) {
    return fail("'" + text + "' is not a numeric address or prefix, as 10.0.0.7 or 10.0.0.0/24");
  }
  Network network{.address = host_of(*address)};
  if (slash == text.npos) return network;

  const int before = address->storage.ss_family == AF_INET ? kMappedBits : 0;
  const auto length = number_in(std::string_view(text).substr(slash + 1));
  if (!length || *length < 0 || *length > kAddressBits - before) {
    return fail("'" + text + "' has no prefix length of 0 to " +
                std::to_string(kAddressBits - before) + " after the slash");
  }
  network.prefix_length = before + *length;
  for (std::size_t i = 0; i < network.address.size(); ++i) {
    if (network.address[i] & ~mask_of(network.prefix_length, i)) {
      return fail("'" + text + "' has bits set after its first " + std::to_string(*length) +
                  "; leave the length out for one host, or set them to 0");
    }
  }
  return network;
}

Result<AccessList> AccessList::create(const std::vector<std::string>& readers,
                                      const std::vector<std::string>& writers) {
  auto may_read = parse_networks(readers);
  if (!may_read) return fail("modbus: readers: " + may_read.error().message);
  auto may_write = parse_networks(writers);
  if (!may_write) return fail("modbus: writers: " + may_write.error().message);
  AccessList list;
  list.readers_ = std::move(*may_read);
  list.writers_ = std::move(*may_write);
  return list;
}

Permission AccessList::of(const HostAddress& client, const HostAddress& server) const {
  const bool is_reader = readers_.empty() || any_contains(readers_, client);
  const bool is_writer =
      writers_.empty() ? is_reader && is_same_host(client, server) : any_contains(writers_, client);
  if (is_writer) return Permission::Write;
  return is_reader ? Permission::Read : Permission::None;
}

}  // namespace orbwatch::app::modbus
