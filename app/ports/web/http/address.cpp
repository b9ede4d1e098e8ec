// SPDX-License-Identifier: Apache-2.0
#include "app/ports/web/http/address.h"

#include <arpa/inet.h>
#include <netinet/in.h>

#include <algorithm>
#include <array>
#include <cctype>

#include "hal/network.h"

namespace orbwatch::app::web {
namespace {

bool is_port(std::string_view text) {
  return !text.empty() && text.size() <= 5 &&
         std::ranges::all_of(text, [](unsigned char c) { return std::isdigit(c) != 0; });
}

/// Removes the root's dot at the end of a name (RFC 1034, 3.1).
std::string_view without_root(std::string_view name) {
  if (name.ends_with('.')) name.remove_suffix(1);
  return name;
}

}  // namespace

bool equal_in_any_case(std::string_view a, std::string_view b) {
  return std::ranges::equal(
      a, b, [](unsigned char x, unsigned char y) { return std::tolower(x) == std::tolower(y); });
}

std::string address_key(const std::string& peer) {
  auto address = hal::parse_host(peer);
  if (!address || hal::is_v4(*address)) return peer;
  constexpr std::size_t kNetworkBytes = 8;
  std::fill(address->begin() + kNetworkBytes, address->end(), 0);
  return hal::text_of(*address) + "/64";
}

std::optional<std::string_view> host_in(std::string_view header) {
  const bool is_bracketed = header.starts_with('[');
  const std::size_t bracket = is_bracketed ? header.find(']') : 0;
  if (bracket == std::string_view::npos) return std::nullopt;
  const std::size_t end = is_bracketed ? bracket + 1 : std::min(header.find(':'), header.size());
  const std::string_view host = header.substr(0, end), rest = header.substr(end);
  if (!rest.empty() && (rest.front() != ':' || !is_port(rest.substr(1)))) return std::nullopt;
  // Functions for C strings would ignore the part after a zero byte.
  if (host.find('\0') != std::string_view::npos) return std::nullopt;
  return host;
}

bool is_own_host(std::string_view header, const std::vector<std::string>& names) {
  const auto host = host_in(header);
  if (!host || host->empty()) return false;
  std::array<std::byte, sizeof(in6_addr)> number;
  const bool is_v6 = host->front() == '[';
  const std::string text(is_v6 ? host->substr(1, host->size() - 2) : *host);
  if (::inet_pton(is_v6 ? AF_INET6 : AF_INET, text.c_str(), number.data()) == 1) return true;
  const std::string_view asked = without_root(*host);
  return equal_in_any_case(asked, "localhost") || std::ranges::any_of(names, [&](const auto& name) {
           return equal_in_any_case(asked, without_root(name));
         });
}

}  // namespace orbwatch::app::web
