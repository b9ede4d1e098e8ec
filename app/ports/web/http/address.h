// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

/// Addresses and names of hosts. All reentrant; none waits for a name server.
namespace orbwatch::app::web {

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
