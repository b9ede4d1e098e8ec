// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>

namespace orbwatch::tests {

/// Initial value of each byte of memory that a test passes to be written: bytes that still have it
/// were not written.
inline constexpr std::uint8_t kUntouched = 0xa5;

}  // namespace orbwatch::tests
