#pragma once

#include <optional>
#include <string>
#include <vector>

namespace orbwatch::app {

/// The IPv4 addresses of this host's interfaces that are up, "eth0 192.168.0.7", sorted; nothing
/// when the system does not tell. A link that is lost keeps its address, unless what sets the
/// system's network up takes it away. Thread-safe.
std::optional<std::vector<std::string>> network_addresses();

}  // namespace orbwatch::app
