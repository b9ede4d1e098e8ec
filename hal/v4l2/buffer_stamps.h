#pragma once

#include "hal/frame/frame.h"
#include "hal/v4l2/device/v4l2_device.h"

namespace orbwatch::hal {

/// A time stamp on the steady clock and what it marks.
struct FrameStamp {
  TimePoint moment;
  StampSource source = StampSource::Arrival;
};

/// The driver's time stamp, or `arrival` when it is of another clock or not plausible. Drivers
/// declare whether they stamp the start of the exposure (USB cameras do) or the end of the frame.
FrameStamp frame_stamp(const FilledBuffer& buffer, TimePoint arrival);

}  // namespace orbwatch::hal
