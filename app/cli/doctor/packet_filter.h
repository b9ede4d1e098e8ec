// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace orbwatch::app::cli::doctor {

using PortRanges = std::vector<std::pair<int, int>>;

/// Properties of a rule set of nftables that can be determined without following its jumps.
struct PacketFilter {
  /// Base chains of input with the policy drop, in nft's notation: family, table, chain.
  std::vector<std::string> closed_chains;
  /// Destination ports in rules that accept or jump, each by the first and the last.
  PortRanges tcp;
  PortRanges udp;
};

/// Parses the output of `nft -j list ruleset` (libnftables-json(5)). Nullopt: not such output.
/// Reentrant.
std::optional<PacketFilter> read_packet_filter(const std::string& json);

bool names_port(const PortRanges& ranges, int port);

}  // namespace orbwatch::app::cli::doctor
