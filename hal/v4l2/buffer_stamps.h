#pragma once

#include "hal/frame.h"
#include "hal/v4l2/v4l2_device.h"

namespace orbwatch::hal {

/// A time stamp on the steady clock and what it tells.
struct FrameStamp {
  TimePoint moment;
  StampSource source = StampSource::Arrival;
};

/// The driver's time stamp, or `arrival` when it gave none of this clock or one that cannot be.
/// Drivers say whether they stamp the start of the exposure (USB cameras do) or the end of the
/// frame.
FrameStamp frame_stamp(const FilledBuffer& buffer, TimePoint arrival);

}  // namespace orbwatch::hal
