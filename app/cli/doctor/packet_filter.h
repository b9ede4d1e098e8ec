#pragma once

#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace orbwatch::app::doctor {

using PortRanges = std::vector<std::pair<int, int>>;

/// What can be said of a rule set of nftables without following its jumps.
struct PacketFilter {
  /// Base chains of input whose policy is drop, as nft names them: family, table, chain.
  std::vector<std::string> closed_chains;
  /// Destination ports that some rule names which accepts or jumps, each by the first and the last.
  PortRanges tcp;
  PortRanges udp;
};

/// Reads the output of `nft -j list ruleset` (libnftables-json(5)). Nullopt: it is none. Reentrant.
std::optional<PacketFilter> read_packet_filter(const std::string& json);

bool names_port(const PortRanges& ranges, int port);

}  // namespace orbwatch::app::doctor
