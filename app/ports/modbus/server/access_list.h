// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "hal/network.h"
#include "proc/image/result.h"

/// Permissions of clients.
namespace orbwatch::app::modbus {

using hal::HostAddress;
using hal::Network;

/// Permission of a client. None: connections are refused. Write includes reading.
enum class Permission : std::uint8_t { None, Read, Write };

/// The permissions of clients by their address: Modbus has no authentication. Immutable; reentrant.
class AccessList {
 public:
  /// Permits all clients to read, and the server's own host to write.
  AccessList() = default;

  /// Networks as for hal::parse_network. No readers: all clients may read. Writers may read. No
  /// writers: readers on the server's own host may write.
  static Result<AccessList> create(const std::vector<std::string>& readers,
                                   const std::vector<std::string>& writers);

  /// `server`: the address by which the client reached the server.
  Permission of(const HostAddress& client, const HostAddress& server) const;

 private:
  std::vector<Network> readers_;
  std::vector<Network> writers_;
};

}  // namespace orbwatch::app::modbus
