#pragma once

#include <linux/videodev2.h>

#include "hal/clock.h"

namespace orbwatch::hal {

/// The driver's time stamp on the steady clock; `arrival` when the driver gave none of this clock
/// or one that cannot be. Most drivers stamp the start of the exposure or of its transfer (UVC);
/// what stamps the end is later by exposure and readout, which V4L2 does not tell.
TimePoint exposure_start(const v4l2_buffer& buffer, TimePoint arrival);

}  // namespace orbwatch::hal
