// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>

namespace orbwatch::app {

/// The number of the result that follows `number`; 0 is none. Registers of PLCs show the lower 32
/// bits, so numbers whose lower half would read as 0 are skipped. Reentrant.
constexpr std::uint64_t next_result(std::uint64_t number) {
  const std::uint64_t next = number + 1;
  return static_cast<std::uint32_t>(next) == 0 ? next + 1 : next;
}

}  // namespace orbwatch::app
