// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <zlib.h>

#include <cstddef>
#include <cstdint>
#include <span>

namespace orbwatch::hal::mcap {

/// CRC-32 of MCAP, which is that of zlib (ISO 3309), continued from `crc`; 0: from the beginning.
inline std::uint32_t crc32_of(std::span<const std::byte> bytes, std::uint32_t crc = 0) {
  if (bytes.empty()) return crc;  // zlib begins anew without bytes
  return static_cast<std::uint32_t>(
      ::crc32_z(crc, reinterpret_cast<const Bytef*>(bytes.data()), bytes.size()));
}

}  // namespace orbwatch::hal::mcap
