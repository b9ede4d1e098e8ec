#pragma once

#include <cstdint>

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

}  // namespace orbwatch::hal
