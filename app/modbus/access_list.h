#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "app/modbus/socket_address.h"
#include "proc/image/result.h"

namespace orbwatch::app::modbus {

/// The addresses that begin with the same bits: one machine, or a CIDR prefix (RFC 4632, RFC 4291).
struct Network {
  HostAddress address{};
  int prefix_length = 128;  ///< in bits of the IPv6 form

  bool contains(const HostAddress& host) const;
};

/// Reads a numeric address or a prefix: 10.0.0.7, 10.0.0.0/24, fd00::/8. Errors: neither, or bits
/// set after the prefix, which would be a machine and not its network. Reentrant.
Result<Network> parse_network(const std::string& text);

/// What a client may do: nothing, not even connect; read; read and write.
enum class Permission : std::uint8_t { None, Read, Write };

/// Who may do what. Modbus has no other way to tell clients apart. Immutable; reentrant.
class AccessList {
 public:
  /// Everybody may do everything.
  AccessList() = default;

  /// Networks as for parse_network. No readers: everybody may read. Who may write may read, too. No
  /// writers: all who may read may write.
  static Result<AccessList> create(const std::vector<std::string>& readers,
                                   const std::vector<std::string>& writers);

  Permission of(const HostAddress& host) const;

 private:
  std::vector<Network> readers_;
  std::vector<Network> writers_;
};

}  // namespace orbwatch::app::modbus
