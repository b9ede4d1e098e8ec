// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstdint>

namespace orbwatch::app {

/// Unique identity of a process. It stays the same when the process executes itself again.
struct ProcessIdentity {
  std::array<char, 36> boot{};  ///< UUID of the kernel's run
  std::uint32_t id = 0;
  std::uint64_t start = 0;  ///< start time in the kernel's ticks since power-on

  bool operator==(const ProcessIdentity&) const = default;
};

/// Identity of this process; all zero if the kernel does not provide it. Reentrant.
ProcessIdentity this_process();

}  // namespace orbwatch::app
