// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <set>
#include <string>
#include <vector>

namespace orbwatch::app::dds {

/// An IPv4 address of one of this host's interfaces.
struct NetworkAddress {
  std::string interface;  ///< "eth0"
  std::string address;    ///< "192.168.0.7"

  bool operator==(const NetworkAddress&) const = default;
};

/// Addresses of the interfaces that are up, sorted; nullopt: the system call failed. An interface
/// that loses its link keeps its address unless the network manager removes it. Thread-safe.
std::optional<std::vector<NetworkAddress>> network_addresses();

/// The sockets that this process has open, by the kernel's names. Thread-safe.
std::set<std::string> open_sockets();

/// The addresses to which this process has bound UDP sockets that are not in `earlier`. Cyclone DDS
/// binds one to each address that it sends from, and has no call that returns them: the sockets
/// opened while it creates a domain are its own, earlier ones belong to others, such as GigE
/// cameras. Thread-safe.
std::set<std::string> bound_addresses(const std::set<std::string>& earlier = {});

/// Decides whether a change of addresses makes a participant rejoin its domain. Cyclone DDS chooses
/// its interfaces by its profile from the addresses that the host has when it joins, and ignores
/// later ones. Changes of other interfaces, of a VPN or a container, do not require it to rejoin.
/// Thread-bound.
class InterfaceWatch {
 public:
  /// Reports a join: the host had the addresses `host`, of which those in `bound` are used.
  /// Interfaces used earlier stay watched, because they may return.
  void joined(const std::vector<NetworkAddress>& host, const std::set<std::string>& bound);

  /// Reports that a participant left or could not join; then every change counts.
  void left() { watches_all_ = true; }

  /// Returns whether `after` differs from `before` in a watched interface.
  bool is_change(const std::vector<NetworkAddress>& before,
                 const std::vector<NetworkAddress>& after) const;

 private:
  std::vector<NetworkAddress> watched(const std::vector<NetworkAddress>& addresses) const;

  std::set<std::string> interfaces_;  ///< interfaces used since the start
  bool watches_all_ = true;
};

}  // namespace orbwatch::app::dds
