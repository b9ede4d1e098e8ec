// SPDX-License-Identifier: Apache-2.0
#include "app/ports/web/http/forwarding.h"

#include <algorithm>
#include <cctype>
#include <optional>
#include <string_view>
#include <utility>

#include "app/ports/web/http/address.h"
#include "app/ports/web/http/header_list.h"

namespace orbwatch::app::web {
namespace {

constexpr std::string_view kForwardedFor = "X-Forwarded-For", kForwarded = "Forwarded",
                           kPrefix = "X-Forwarded-";

std::string unquoted(std::string_view text) {
  if (text.size() < 2 || text.front() != '"' || text.back() != '"') return std::string(text);
  std::string plain;
  for (std::size_t i = 1; i + 1 < text.size(); ++i) {
    if (text[i] == '\\' && i + 2 < text.size()) ++i;
    plain += text[i];
  }
  return plain;
}

const std::vector<std::string_view> kNothing;

/// The parameter of each element of Forwarded; empty where an element has none.
std::vector<std::string> parameters_of(const std::vector<std::string>& forwarded,
                                       std::string_view name) {
  std::vector<std::string> values;
  for (const std::string& element : forwarded) {
    std::string value;
    for (const std::string_view pair : split(element, ';', Quotes::Hold).value_or(kNothing)) {
      const std::size_t equals = pair.find('=');
      if (equals != std::string_view::npos && equal_in_any_case(pair.substr(0, equals), name)) {
        value = unquoted(pair.substr(equals + 1));
      }
    }
    values.push_back(std::move(value));
  }
  return values;
}

/// The host in 10.0.0.7, 10.0.0.7:4711, fd00::1, [fd00::1] or [fd00::1]:4711.
std::optional<hal::HostAddress> node_address(const std::string& node) {
  if (auto plain = hal::parse_host(node)) return plain;
  const auto host = host_in(node);
  if (!host || host->empty()) return std::nullopt;
  const bool is_bracketed = host->front() == '[';
  return hal::parse_host(std::string(is_bracketed ? host->substr(1, host->size() - 2) : *host));
}

/// The client, and its distance from the end of the list.
struct Client {
  std::string address;
  std::size_t place = 0;
};

/// Each proxy appends the address from which it received the request, so the list is reliable from
/// its end to the first address that is not trusted.
Client client_in(const std::vector<std::string>& nodes, const std::string& peer,
                 const std::vector<hal::Network>& trusted) {
  Client client{peer, 0};
  for (std::size_t place = 0; place < nodes.size(); ++place) {
    const auto address = node_address(nodes[nodes.size() - 1 - place]);
    if (!address) break;
    client = {hal::text_of(*address), place};
    if (!hal::any_contains(trusted, *address)) break;
  }
  return client;
}

/// The value at the client's place; the first one of a shorter list. Empty: none.
std::string beside(const std::vector<std::string>& values, std::size_t place) {
  return values.empty() ? "" : values[values.size() - 1 - std::min(place, values.size() - 1)];
}

/// Checks a path without "." and "..", usable as a cookie's attribute; removes slashes at its end.
std::optional<std::string> path_prefix(std::string text) {
  while (text.ends_with('/')) text.pop_back();
  if (text.empty()) return text;
  const bool is_plain = std::ranges::all_of(text, [](unsigned char c) {
    return std::isalnum(c) != 0 ||
           std::string_view("/-._~%").find(static_cast<char>(c)) != std::string_view::npos;
  });
  const bool has_dots = (text + "/").find("/./") != std::string::npos ||
                        (text + "/").find("/../") != std::string::npos;
  const bool is_path = is_plain && !has_dots && text.front() == '/' && !text.starts_with("//");
  return is_path ? std::optional(text) : std::nullopt;
}

}  // namespace

bool is_passed_on(const Values& headers) {
  return std::ranges::any_of(headers, [](const auto& header) {
    const std::string_view name = header.first;
    return equal_in_any_case(name, kForwarded) || equal_in_any_case(name, "Via") ||
           equal_in_any_case(name, "X-Real-IP") ||
           equal_in_any_case(name.substr(0, kPrefix.size()), kPrefix);
  });
}

bool is_trusted(const std::string& peer, const std::vector<hal::Network>& trusted) {
  const auto address = hal::parse_host(peer);
  return address && hal::any_contains(trusted, *address);
}

Result<> take_forwarding(Request& request, const std::vector<hal::Network>& trusted) {
  if (!is_trusted(request.peer, trusted)) {
    if (is_passed_on(request.headers)) request.passage = Passage::UntrustedProxy;
    return {};
  }
  request.passage = Passage::TrustedProxy;
  const auto forwarded = list_of(request, kForwarded, Quotes::Hold);
  if (!forwarded) return fail("Forwarded has a quoted string without an end");
  const auto nodes = plain_list_of(request, kForwardedFor);
  const Client by_list = client_in(nodes, request.peer, trusted),
               by_standard = client_in(parameters_of(*forwarded, "for"), request.peer, trusted);
  if (!nodes.empty() && !forwarded->empty() && by_list.address != by_standard.address) {
    return fail(
        "Forwarded and X-Forwarded-For name different clients; the proxy must remove the one that "
        "it does not set itself");
  }
  const Client& client = nodes.empty() ? by_standard : by_list;
  request.peer = client.address;
  const auto said = [&](std::string_view header, std::string_view parameter) {
    const std::string value = beside(plain_list_of(request, header), client.place);
    return value.empty() ? beside(parameters_of(*forwarded, parameter), client.place) : value;
  };
  if (const std::string scheme = said("X-Forwarded-Proto", "proto"); !scheme.empty()) {
    request.is_secure = equal_in_any_case(scheme, "https");
  }
  if (std::string host = said("X-Forwarded-Host", "host"); !host.empty()) {
    request.host = std::move(host);
  }
  const auto prefix =
      path_prefix(beside(plain_list_of(request, "X-Forwarded-Prefix"), client.place));
  if (!prefix) return fail("X-Forwarded-Prefix must be a path such as /cell4/orbwatch");
  request.prefix = *prefix;
  return {};
}

}  // namespace orbwatch::app::web
