#pragma once

#include <chrono>

#include "hal/frame/frame.h"

namespace orbwatch::hal {

/// What a site knows of a camera's time stamps beyond what the camera states.
struct StampSettings {
  /// From the first row to the last, of a data sheet; stamps at the end of a frame are later by it.
  std::chrono::microseconds readout_time{0};
  /// How much later stamps are besides, as measured; below 0: earlier.
  std::chrono::microseconds offset{0};
};

/// When the exposure of a frame's first row began, from the stamp in `metadata.exposure_start`,
/// which marks what `metadata.stamp_source` says: the exposure ends where the readout begins. An
/// exposure time that the camera does not state is not subtracted. Reentrant.
inline TimePoint exposure_start(const FrameMetadata& metadata, const StampSettings& settings) {
  TimePoint start = metadata.exposure_start - settings.offset;
  if (metadata.stamp_source == StampSource::ExposureStart) return start;
  start -= metadata.exposure_time;
  return metadata.stamp_source == StampSource::ReadoutStart ? start : start - settings.readout_time;
}

}  // namespace orbwatch::hal
