#pragma once

#include <algorithm>
#include <chrono>

#include "hal/clock.h"

namespace orbwatch::hal {

/// Pauses between attempts to reach a camera or a line again: 1 s, 2 s, 4 s, 8 s, then 10 s each.
class BackOff {
 public:
  Clock::duration next() {
    const Clock::duration pause = next_;
    next_ = std::min(2 * next_, kLongest);
    return pause;
  }
  /// It was reached.
  void reset() { next_ = kFirst; }

 private:
  static constexpr Clock::duration kFirst = std::chrono::seconds(1);
  static constexpr Clock::duration kLongest = std::chrono::seconds(10);
  Clock::duration next_ = kFirst;
};

/// Cameras settle their exposure before the first frame.
constexpr Clock::duration kFirstFrameTimeout = std::chrono::seconds(5);

/// How long a camera may be silent: 5 periods of `frame_rate`, and 1 s at least; 5 s when its rate
/// is not known (0).
inline Clock::duration stall_timeout(double frame_rate) {
  using std::chrono::seconds;
  if (frame_rate <= 0) return seconds(5);
  const std::chrono::duration<double> periods(5.0 / frame_rate);
  return std::max<Clock::duration>(seconds(1),
                                   std::chrono::duration_cast<Clock::duration>(periods));
}

}  // namespace orbwatch::hal
