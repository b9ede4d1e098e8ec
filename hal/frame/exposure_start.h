// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <chrono>

#include "hal/frame/frame.h"

namespace orbwatch::hal {

/// True for a stamp that a frame which arrives now may have: a driver's few buffers hold none older
/// than a minute, so an older one belongs to another clock, as does a later one. Reentrant.
inline bool is_plausible(TimePoint stamp, TimePoint arrival) {
  constexpr std::chrono::seconds kOldest{60};
  return stamp <= arrival && stamp >= arrival - kOldest;
}

/// Facts about a camera's time stamps that the site states in addition to the camera.
struct StampSettings {
  /// Time from the first row to the last, from a data sheet; stamps at the end of a frame are later
  /// by it.
  std::chrono::microseconds readout_time{0};
  /// Measured additional delay of the stamps; below 0: earlier.
  std::chrono::microseconds offset{0};
};

/// Start of the exposure of a frame's first row, from the stamp in `metadata.exposure_start`, whose
/// meaning is `metadata.stamp_source`: the exposure ends where the readout begins. An exposure time
/// that the camera does not state is not subtracted. Reentrant.
inline TimePoint exposure_start(const FrameMetadata& metadata, const StampSettings& settings) {
  TimePoint start = metadata.exposure_start - settings.offset;
  if (metadata.stamp_source == StampSource::ExposureStart) return start;
  start -= metadata.exposure_time;
  return metadata.stamp_source == StampSource::ReadoutStart ? start : start - settings.readout_time;
}

}  // namespace orbwatch::hal
