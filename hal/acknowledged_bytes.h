// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>

namespace orbwatch::hal {

/// Bytes that the client's kernel has acknowledged since the TCP connection opened; 0: not known.
/// Reentrant.
std::uint64_t acknowledged_bytes(int socket);

}  // namespace orbwatch::hal
