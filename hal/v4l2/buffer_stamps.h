#pragma once

#include <linux/videodev2.h>

#include <cstdint>

#include "hal/clock.h"

namespace orbwatch::hal {

/// Makes one running number out of a driver's 32-bit frame counter, which wraps, starts anew with
/// each stream and stands still with some drivers.
class FrameCounter {
 public:
  /// The next frame comes from a new stream: it follows the last one.
  void restart() { fresh_ = true; }

  /// The number of a frame. It starts at 0 and grows by as much as the driver's counter; by 1 for
  /// the first frame of a stream and when the driver's counter did not go forward.
  std::uint64_t number(std::uint32_t driver_sequence);

 private:
  std::uint64_t next_ = 0;
  std::uint32_t last_ = 0;
  bool fresh_ = true;
};

/// The driver's time stamp on the steady clock; `arrival` when the driver gave none of this clock
/// or one that cannot be. Most drivers stamp the start of the exposure or of its transfer (UVC);
/// what stamps the end is later by exposure and readout, which V4L2 does not tell.
TimePoint exposure_start(const v4l2_buffer& buffer, TimePoint arrival);

}  // namespace orbwatch::hal
