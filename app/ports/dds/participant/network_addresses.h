#pragma once

#include <optional>
#include <set>
#include <string>
#include <vector>

namespace orbwatch::app {

/// An IPv4 address of one of this host's interfaces.
struct NetworkAddress {
  std::string interface;  ///< "eth0"
  std::string address;    ///< "192.168.0.7"

  bool operator==(const NetworkAddress&) const = default;
};

/// Those of the interfaces that are up, sorted; nullopt when the system call fails. An interface
/// that loses its link keeps its address unless the network manager removes it. Thread-safe.
std::optional<std::vector<NetworkAddress>> network_addresses();

/// The addresses to which this process has bound UDP sockets. Cyclone DDS binds one to each address
/// that it sends from, and has no call that tells them. Thread-safe.
std::set<std::string> bound_addresses();

/// On which interfaces a change of addresses makes a participant of a domain join again. Cyclone
/// DDS chooses its interfaces, as its profile says, from the addresses that the host has when it
/// joins, and ignores later ones. Others, of a VPN or a container, are no reason to leave.
/// Thread-bound.
class InterfaceWatch {
 public:
  /// A participant joined: the host had the addresses `host`, of which those in `bound` are used.
  /// What was used earlier stays watched, as it may come back.
  void joined(const std::vector<NetworkAddress>& host, const std::set<std::string>& bound);

  /// A participant left, or could not join: every change may help.
  void left() { watches_all_ = true; }

  /// Whether `after` differs from `before` where it counts.
  bool is_change(const std::vector<NetworkAddress>& before,
                 const std::vector<NetworkAddress>& after) const;

 private:
  std::vector<NetworkAddress> watched(const std::vector<NetworkAddress>& addresses) const;

  std::set<std::string> interfaces_;  ///< used since the start
  bool watches_all_ = true;
};

}  // namespace orbwatch::app
