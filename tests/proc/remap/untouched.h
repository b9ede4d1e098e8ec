#pragma once

#include <cstdint>

namespace orbwatch::tests {

/// Each byte of memory that a test hands out to be written: what holds it later was not written.
inline constexpr std::uint8_t kUntouched = 0xa5;

}  // namespace orbwatch::tests
