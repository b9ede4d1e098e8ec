#pragma once

#include <array>
#include <cstdint>

namespace orbwatch::app {

/// A process, unlike any other before or after it. It stays the same when the process executes
/// itself again.
struct ProcessIdentity {
  std::array<char, 36> boot{};  ///< UUID of the kernel's run
  std::uint32_t id = 0;
  std::uint64_t start = 0;  ///< in the kernel's ticks since power-on

  bool operator==(const ProcessIdentity&) const = default;
};

/// Identity of this process; all zero when the kernel does not say. Reentrant.
ProcessIdentity this_process();

}  // namespace orbwatch::app
