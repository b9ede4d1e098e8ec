#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "app/ports/modbus/server/socket_address.h"
#include "proc/image/result.h"

namespace orbwatch::app::modbus {

/// One host, or all hosts of a CIDR prefix (RFC 4632, RFC 4291).
struct Network {
  HostAddress address{};
  int prefix_length = 128;  ///< in bits of the IPv6 form

  bool contains(const HostAddress& host) const;
};

/// Parses a numeric address or a prefix: 10.0.0.7, 10.0.0.0/24, fd00::/8. Errors: neither, or bits
/// set after the prefix, as in a host's address. Reentrant.
Result<Network> parse_network(const std::string& text);

/// None: the client may not even connect. Write includes reading.
enum class Permission : std::uint8_t { None, Read, Write };

/// The permissions of clients by their address: Modbus has no authentication. Immutable; reentrant.
class AccessList {
 public:
  /// Everybody may read and write.
  AccessList() = default;

  /// Networks as for parse_network. No readers: everybody may read. Writers may read. No writers:
  /// all readers may write.
  static Result<AccessList> create(const std::vector<std::string>& readers,
                                   const std::vector<std::string>& writers);

  Permission of(const HostAddress& host) const;

 private:
  std::vector<Network> readers_;
  std::vector<Network> writers_;
};

}  // namespace orbwatch::app::modbus
