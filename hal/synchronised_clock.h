// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <sys/timex.h>

/// Synchronisation state of the system's clock from the kernel: it follows a time server or not.
/// All reentrant.
namespace orbwatch::hal {

/// Evaluates the result of adjtimex().
inline bool is_synchronised(const timex& clock) { return (clock.status & STA_UNSYNC) == 0; }

/// False also when the kernel does not report it.
inline bool is_clock_synchronised() {
  timex clock{};
  return ::adjtimex(&clock) >= 0 && is_synchronised(clock);
}

}  // namespace orbwatch::hal
