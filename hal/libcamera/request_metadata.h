#pragma once

#include <libcamera/controls.h>

#include <chrono>
#include <cstdint>
#include <optional>

#include "hal/frame/frame.h"

namespace orbwatch::hal {

/// Two of the kernel's clocks at one moment.
struct ClockReading {
  TimePoint steady;               ///< CLOCK_MONOTONIC
  std::chrono::nanoseconds boot;  ///< CLOCK_BOOTTIME, which includes suspend

  static ClockReading now();
};

/// A frame's stamp on the steady clock, or nullopt when it is in the future or a minute old.
/// libcamera documents CLOCK_BOOTTIME, but several pipelines forward their driver's
/// CLOCK_MONOTONIC. The two differ only after a suspend, and then boot stamps are in the future.
std::optional<TimePoint> to_steady(std::chrono::nanoseconds stamp, const ClockReading& arrival);

/// A frame's metadata from its request; the sequence stays 0. Without SensorTimestamp,
/// `buffer_stamp` (ns) counts; where that is not plausible, `arrival`.
FrameMetadata metadata_of(const libcamera::ControlList& request, std::uint64_t buffer_stamp,
                          const ClockReading& arrival);

}  // namespace orbwatch::hal
