// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <chrono>

#include "hal/frame/frame.h"

namespace orbwatch::hal {

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
