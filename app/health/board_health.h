// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <sys/timex.h>

#include <filesystem>

#include "app/health/throttling.h"
#include "app/model/status/health.h"

namespace orbwatch::app {

/// Sources of the figures; tests use trees of their own.
struct HealthSources {
  std::filesystem::path sys = "/sys";
  std::filesystem::path proc = "/proc";
  std::filesystem::path disk = "/";  ///< a folder on the monitored disk
};

/// Reads the figures of the board and of this process. Every value is range-checked; unreadable and
/// implausible ones are not valid. Thread-bound; may wait for the disk, so it needs a thread of its
/// own (HealthSampler).
class BoardHealth {
 public:
  explicit BoardHealth(HealthSources sources);

  /// processor_load is valid from the second reading on.
  Health read();

 private:
  /// Ticks of the kernel since power-on.
  struct ProcessorTime {
    double idle = 0;
    double total = 0;
  };

  static std::optional<ProcessorTime> processor_time(const std::filesystem::path& proc);
  double processor_load();

  HealthSources sources_;
  ThrottlingMonitor throttling_;
  std::optional<ProcessorTime> processor_time_;  ///< value at the last reading
};

/// Sets the clock_ figures of `health` from adjtimex(), whose result is `state`, below 0 on
/// failure. The errors of an unsynchronised clock are not valid. Reentrant.
void note_clock(int state, const timex& clock, Health& health);

}  // namespace orbwatch::app
