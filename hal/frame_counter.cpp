#include "hal/frame_counter.h"

namespace orbwatch::hal {

std::uint64_t FrameCounter::number(std::uint32_t driver_sequence) {
  const std::uint32_t step = driver_sequence - last_;
  const bool forward = step != 0 && step <= UINT32_MAX / 2;
  if (!fresh_ && forward) next_ += step - 1;
  fresh_ = false;
  last_ = driver_sequence;
  return next_++;
}

}  // namespace orbwatch::hal
