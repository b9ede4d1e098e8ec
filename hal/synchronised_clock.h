#pragma once

#include <sys/timex.h>

/// Whether the system's clock follows a time server, as the kernel knows it. All reentrant.
namespace orbwatch::hal {

/// By what adjtimex() filled in.
inline bool is_synchronised(const timex& clock) { return (clock.status & STA_UNSYNC) == 0; }

/// False also when the kernel does not say.
inline bool is_clock_synchronised() {
  timex clock{};
  return ::adjtimex(&clock) >= 0 && is_synchronised(clock);
}

}  // namespace orbwatch::hal
