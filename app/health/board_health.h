#pragma once

#include <sys/timex.h>

#include <filesystem>

#include "app/health/health.h"
#include "app/health/throttling.h"

namespace orbwatch::app {

/// Where the figures are read. Tests make up trees of their own.
struct HealthSources {
  std::filesystem::path sys = "/sys";
  std::filesystem::path proc = "/proc";
  std::filesystem::path disk = "/";  ///< a folder on the disk that counts
};

/// Reads the figures of the board and of this process. Nothing it finds is believed before it is
/// checked; what cannot be read or is out of its range is not valid. Thread-bound; may wait for the
/// disk, so it is for a thread of its own (HealthSampler).
class BoardHealth {
 public:
  explicit BoardHealth(HealthSources sources);

  /// processor_load is valid from the second reading on.
  Health read();

 private:
  /// In the kernel's ticks since power-on.
  struct ProcessorTime {
    double idle = 0;
    double total = 0;
  };

  static std::optional<ProcessorTime> processor_time(const std::filesystem::path& proc);
  double processor_load();

  HealthSources sources_;
  ThrottlingMonitor throttling_;
  std::optional<ProcessorTime> processor_time_;  ///< at the last reading
};

/// What the kernel says of its clock: `state` is what adjtimex() returned, below 0 when it failed.
/// Sets the clock_ figures of `health`; errors of a clock that nobody sets are not valid.
/// Reentrant.
void note_clock(int state, const timex& clock, Health& health);

}  // namespace orbwatch::app
