// SPDX-License-Identifier: Apache-2.0
#include "hal/network.h"

#include <arpa/inet.h>
#include <netinet/in.h>

#include <algorithm>
#include <charconv>
#include <string_view>

namespace orbwatch::hal {
namespace {

constexpr int kAddressBits = 128;
constexpr int kMappedBits = 8 * kV4Begin;

/// Mask of the byte at `place` of an address with `prefix_length` leading ones.
std::uint8_t mask_of(int prefix_length, std::size_t place) {
  const int bits = std::clamp(prefix_length - 8 * static_cast<int>(place), 0, 8);
  return static_cast<std::uint8_t>(0xff00 >> bits);
}

/// Parses a whole number without any other text.
std::optional<int> number_in(std::string_view text) {
  int number = 0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), number);
  if (error != std::errc() || end != text.data() + text.size()) return std::nullopt;
  return number;
}

}  // namespace

std::optional<HostAddress> parse_host(const std::string& text) {
  HostAddress host = kAnyV4;
  if (::inet_pton(AF_INET, text.c_str(), &host[kV4Begin]) == 1) return host;
  if (::inet_pton(AF_INET6, text.c_str(), host.data()) == 1) return host;
  return std::nullopt;
}

std::string text_of(const HostAddress& host) {
  std::array<char, INET6_ADDRSTRLEN> text{};
  const bool is_mapped = is_v4(host);
  ::inet_ntop(is_mapped ? AF_INET : AF_INET6, host.data() + (is_mapped ? kV4Begin : 0), text.data(),
              text.size());
  return text.data();
}

bool is_v4(const HostAddress& host) {
  return std::equal(host.begin(), host.begin() + kV4Begin, kAnyV4.begin());
}

bool is_loopback(const HostAddress& host) {
  static const std::vector<Network> kLoopback{parse_network("127.0.0.0/8").value(),
                                              parse_network("::1").value()};
  return any_contains(kLoopback, host);
}

bool is_loopback(const std::string& text) {
  const auto host = parse_host(text);
  return host && is_loopback(*host);
}

bool Network::contains(const HostAddress& host) const {
  for (std::size_t i = 0; i < host.size(); ++i) {
    if ((host[i] ^ address[i]) & mask_of(prefix_length, i)) return false;
  }
  return true;
}

Result<Network> parse_network(const std::string& text) {
  const std::size_t slash = text.find('/');
  const std::string before_slash = text.substr(0, slash);
  const auto address = parse_host(before_slash);
  if (!address) {
    return fail("'" + text + "' is not a numeric address or prefix, as 10.0.0.7 or 10.0.0.0/24");
  }
  Network network{.address = *address};
  if (slash == text.npos) return network;

  const int before = before_slash.find(':') == text.npos ? kMappedBits : 0;
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

Result<std::vector<Network>> parse_networks(const std::vector<std::string>& texts) {
  std::vector<Network> networks;
  for (const std::string& text : texts) {
    const auto network = parse_network(text);
    if (!network) return tl::unexpected(network.error());
    networks.push_back(*network);
  }
  return networks;
}

bool is_everybody(const Network& network) {
  return network.prefix_length <= kMappedBits &&
         (network.prefix_length == 0 || is_v4(network.address));
}

bool any_contains(const std::vector<Network>& networks, const HostAddress& host) {
  return std::ranges::any_of(networks,
                             [&](const Network& network) { return network.contains(host); });
}

}  // namespace orbwatch::hal
