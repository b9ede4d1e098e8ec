#pragma once

#include <libcamera/controls.h>

#include <chrono>
#include <cstdint>
#include <optional>

#include "hal/frame.h"

namespace orbwatch::hal {

/// What two clocks of the kernel showed at one moment.
struct ClockReading {
  TimePoint steady;               ///< CLOCK_MONOTONIC
  std::chrono::nanoseconds boot;  ///< CLOCK_BOOTTIME, which counts on while the machine sleeps

  static ClockReading now();
};

/// A frame's stamp on the steady clock, or nothing if it cannot be: in the future, or a minute old.
/// libcamera says that stamps are of CLOCK_BOOTTIME, but several pipelines hand on their driver's
/// of CLOCK_MONOTONIC. Only after a sleep do they differ, and then the boot clock's lie in the
/// future.
std::optional<TimePoint> to_steady(std::chrono::nanoseconds stamp, const ClockReading& arrival);

/// A frame's metadata out of its request's; its sequence is left at 0. `buffer_stamp` (ns) counts
/// where there is no SensorTimestamp, `arrival` where that is of no use, too.
FrameMetadata metadata_of(const libcamera::ControlList& request, std::uint64_t buffer_stamp,
                          const ClockReading& arrival);

}  // namespace orbwatch::hal
