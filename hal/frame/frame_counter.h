#pragma once

#include <cstdint>

namespace orbwatch::hal {

/// Extends a driver's 32-bit frame counter, which wraps, restarts with each stream and is constant
/// with some drivers, to one sequence.
class FrameCounter {
 public:
  /// The next frame is the first of a new stream and follows the last one.
  void restart() { fresh_ = true; }

  /// The number of a frame. It starts at 0 and grows by as much as the driver's counter; by 1 for
  /// the first frame of a stream and when the driver's counter did not go forward.
  std::uint64_t number(std::uint32_t driver_sequence) {
    const std::uint32_t step = driver_sequence - last_;
    const bool forward = step != 0 && step <= UINT32_MAX / 2;
    if (!fresh_ && forward) next_ += step - 1;
    fresh_ = false;
    last_ = driver_sequence;
    return next_++;
  }

 private:
  std::uint64_t next_ = 0;
  std::uint32_t last_ = 0;
  bool fresh_ = true;
};

}  // namespace orbwatch::hal
