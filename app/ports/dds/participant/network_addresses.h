#pragma once

#include <optional>
#include <string>
#include <vector>

namespace orbwatch::app {

/// The IPv4 addresses of this host's interfaces that are up, "eth0 192.168.0.7", sorted; nullopt
/// when the system call fails. An interface that loses its link keeps its address unless the
/// network manager removes it. Thread-safe.
std::optional<std::vector<std::string>> network_addresses();

}  // namespace orbwatch::app
