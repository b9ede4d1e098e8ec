// SPDX-License-Identifier: Apache-2.0
#include "app/ports/dds/participant/network_addresses.h"

#include <ifaddrs.h>
#include <net/if.h>
#include <sys/socket.h>

#include <algorithm>
#include <charconv>
#include <filesystem>
#include <iterator>
#include <memory>
#include <system_error>
#include <tuple>

#include "hal/host.h"
#include "hal/socket_address.h"

namespace orbwatch::app::dds {
namespace {

/// The IPv4 address to which the UDP socket `file` is bound; nullopt: not such a socket, or bound
/// to all addresses.
std::optional<std::string> bound_address(int file) {
  int type = 0;
  socklen_t length = sizeof type;
  if (getsockopt(file, SOL_SOCKET, SO_TYPE, &type, &length) != 0 || type != SOCK_DGRAM) return {};
  hal::SocketAddress name;
  if (getsockname(file, name.get(), &name.length) != 0 || name.family() != AF_INET) return {};
  std::string address = hal::text_of(name.host());
  return hal::is_unspecified(address) ? std::nullopt : std::optional(std::move(address));
}

/// Calls `visit` with the number and the name, "socket:[INODE]", of each open socket of this
/// process. Reads names only: the other files belong to other threads, which may close them.
template <class Visit>
void for_each_socket(const Visit& visit) {
  std::error_code unreadable;  // e.g. without /proc: further ones stay unknown
  std::filesystem::directory_iterator open_file("/proc/self/fd", unreadable);
  for (; open_file != std::filesystem::directory_iterator(); open_file.increment(unreadable)) {
    std::error_code closed;
    const std::string name = std::filesystem::read_symlink(*open_file, closed);
    if (!name.starts_with("socket:")) continue;
    const std::string number = open_file->path().filename();
    int file = -1;
    std::from_chars(number.data(), number.data() + number.size(), file);
    visit(file, name);
  }
}

bool is_loopback(const NetworkAddress& address) {
  const auto host = hal::parse_host(address.address);
  return host && hal::is_loopback(*host);
}

}  // namespace

std::optional<std::vector<NetworkAddress>> network_addresses() {
  ifaddrs* found = nullptr;
  if (getifaddrs(&found) != 0) return std::nullopt;
  const std::unique_ptr<ifaddrs, void (*)(ifaddrs*)> list(found, freeifaddrs);
  std::vector<NetworkAddress> addresses;
  for (const ifaddrs* at = found; at != nullptr; at = at->ifa_next) {
    const bool up = (at->ifa_flags & IFF_UP) != 0;
    if (!up || at->ifa_addr == nullptr || at->ifa_addr->sa_family != AF_INET) continue;
    addresses.push_back({at->ifa_name, hal::text_of(hal::SocketAddress(at->ifa_addr).host())});
  }
  std::ranges::sort(addresses, {}, [](const NetworkAddress& address) {
    return std::tie(address.interface, address.address);
  });
  return addresses;
}

std::set<std::string> open_sockets() {
  std::set<std::string> sockets;
  for_each_socket([&sockets](int, const std::string& name) { sockets.insert(name); });
  return sockets;
}

std::set<std::string> bound_addresses(const std::set<std::string>& earlier) {
  std::set<std::string> addresses;
  for_each_socket([&](int file, const std::string& name) {
    if (earlier.contains(name)) return;
    if (auto address = bound_address(file)) addresses.insert(std::move(*address));
  });
  return addresses;
}

void InterfaceWatch::joined(const std::vector<NetworkAddress>& host,
                            const std::set<std::string>& bound) {
  bool is_known = false;
  for (const NetworkAddress& address : host) {
    if (!bound.contains(address.address)) continue;
    interfaces_.insert(address.interface);
    is_known = true;
  }
  // If no used interface is known, or the host has only loopback, any new interface may be
  // suitable.
  watches_all_ = !is_known || std::ranges::all_of(host, is_loopback);
}

bool InterfaceWatch::is_change(const std::vector<NetworkAddress>& before,
                               const std::vector<NetworkAddress>& after) const {
  return watched(before) != watched(after);
}

std::vector<NetworkAddress> InterfaceWatch::watched(
    const std::vector<NetworkAddress>& addresses) const {
  std::vector<NetworkAddress> kept;
  std::ranges::copy_if(addresses, std::back_inserter(kept), [this](const NetworkAddress& address) {
    return watches_all_ || interfaces_.contains(address.interface);
  });
  return kept;
}

}  // namespace orbwatch::app::dds
