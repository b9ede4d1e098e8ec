// SPDX-License-Identifier: Apache-2.0
#include <cerrno>
#include <system_error>

#include "app/cli/doctor/checks.h"
#include "app/cli/doctor/packet_filter.h"
#include "hal/network.h"

/// Checks of ports, buffers and packet filter.
namespace orbwatch::app::cli::doctor {
namespace {

constexpr std::int64_t kLeastBuffer = std::int64_t{8} << 20;  // bytes; the package sets 16 MiB

// First UDP port of a domain (DDSI-RTPS 2.2, 9.6.1), for discovery.
constexpr int kFirstDdsPort = 7400;
constexpr int kDdsPorts = 250;

Diagnosis privileged(const std::string& who, const PortFacts& port, const NetworkFacts& network) {
  if (network.has_unit) {
    return ok(who + ": free; it takes the capability that orbwatch.service has");
  }
  return fault(who + ": needs the capability CAP_NET_BIND_SERVICE",
               "sudo sysctl -w net.ipv4.ip_unprivileged_port_start=" + std::to_string(port.port));
}

Diagnosis taken(const std::string& who, const PortFacts& port) {
  if (!port.other_configuration.empty()) {
    return fault(who + ": taken by the orbwatchd of " + port.other_configuration.string(),
                 "another port in [" + port.key + "]");
  }
  if (port.holder == "orbwatchd") return ok(who + ": held by orbwatchd");
  if (!port.holder.empty()) {
    return fault(who + ": taken by " + port.holder,
                 "sudo ss -ltnp sport = :" + std::to_string(port.port) +
                     " shows who; end it, or another port in [" + port.key + "]");
  }
  if (port.service_runs) {
    return warning(who + ": taken; whether by orbwatchd, which runs, this user cannot see",
                   "sudo orbwatch doctor");
  }
  return fault(who + ": taken by a program that this user cannot see", "sudo orbwatch doctor");
}

Diagnosis port_diagnosis(const PortFacts& port, const NetworkFacts& network) {
  const std::string who = port.key + " " + port.address + ":" + std::to_string(port.port);
  switch (port.error) {
    case 0: {
      const bool below = network.first_free_port && port.port < *network.first_free_port;
      return below ? privileged(who, port, network) : ok(who + ": free");
    }
    case EADDRINUSE:
      return taken(who, port);
    case EACCES:
      return privileged(who, port, network);
    case EADDRNOTAVAIL:
      return fault(who + ": no network interface has this address",
                   "mend address in [" + port.key + "]; ip address shows them");
    default:
      return fault(who + ": " + std::generic_category().message(port.error),
                   "mend address and port in [" + port.key + "]");
  }
}

/// Diagnosis of a chain that filters the protocol's `ports`, with the rule of `chain` that would
/// accept them.
Diagnosis filtered(const std::string& who, const std::string& chain, const std::string& ports) {
  return warning(who + ": the chain " + chain + " drops input, and no rule names " + ports,
                 "sudo nft add rule " + chain + " " + ports + " accept");
}

Diagnoses nft_diagnoses(const Facts& facts, const PacketFilter& filter) {
  Diagnoses found;
  if (filter.closed_chains.empty()) return {ok("no chain of nftables drops input by its policy")};
  const std::string& chain = filter.closed_chains.front();
  const auto add = [&](const std::string& who, const std::string& ports, bool is_named) {
    found.push_back(is_named ? ok(who + ": a rule names " + ports) : filtered(who, chain, ports));
  };
  for (const PortFacts& port : facts.ports) {
    if (hal::is_loopback(port.address)) continue;
    add(port.key, "tcp dport " + std::to_string(port.port), names_port(filter.tcp, port.port));
  }
  if (facts.site && std::get<DdsSettings>(facts.site->sinks).enabled) {
    const int first = kFirstDdsPort + kDdsPorts * std::get<DdsSettings>(facts.site->sinks).domain;
    add("dds, for other computers",
        "udp dport " + std::to_string(first) + "-" + std::to_string(first + kDdsPorts - 1),
        names_port(filter.udp, first));
  }
  if (found.empty()) found.push_back(ok("the chain " + chain + " drops input; no port is served"));
  return found;
}

}  // namespace

Diagnoses check_receive_buffer(const Facts& facts) {
  if (!facts.site || !std::get<DdsSettings>(facts.site->sinks).enabled) return {};
  const auto& bytes = facts.network.largest_receive_buffer;
  if (!bytes) return {warning("net.core.rmem_max cannot be read", "sysctl net.core.rmem_max")};
  const std::string text = "net.core.rmem_max = " + std::to_string(*bytes);
  if (*bytes >= kLeastBuffer) return {ok(text)};
  return {warning(text + ": pictures over DDS may be lost",
                  facts.network.has_sysctl_file ? "sudo sysctl --system"
                                                : "sudo sysctl -w net.core.rmem_max=16777216")};
}

Diagnoses check_ports(const Facts& facts) {
  Diagnoses found;
  for (const PortFacts& port : facts.ports) {
    found.push_back(port_diagnosis(port, facts.network));
  }
  if (facts.missing_serial_line) {
    found.push_back(fault("modbus.serial " + *facts.missing_serial_line + ": is not there",
                          "connect it; ls /dev/serial/by-id shows adapters"));
  }
  return found;
}

Diagnoses check_firewall(const Facts& facts) {
  const FirewallFacts& firewall = facts.firewall;
  if (firewall.has_iptables) {
    return {warning("there are tables of iptables, which are not judged here",
                    "sudo iptables -L INPUT -n")};
  }
  if (!firewall.has_nft) return {ok("nft is not installed, and iptables has no tables")};
  const auto filter = firewall.ruleset ? read_packet_filter(*firewall.ruleset) : std::nullopt;
  if (!filter) {
    return {warning("the rules of nftables cannot be read", "sudo orbwatch doctor")};
  }
  return nft_diagnoses(facts, *filter);
}

}  // namespace orbwatch::app::cli::doctor
