#pragma once

#include <sys/timex.h>

/// State of the system's clock, as the kernel knows it: follows a time server or not. All
/// reentrant.
namespace orbwatch::hal {

/// Reads what adjtimex() filled in.
inline bool is_synchronised(const timex& clock) { return (clock.status & STA_UNSYNC) == 0; }

/// False also when the kernel does not say.
inline bool is_clock_synchronised() {
  timex clock{};
  return ::adjtimex(&clock) >= 0 && is_synchronised(clock);
}

}  // namespace orbwatch::hal
