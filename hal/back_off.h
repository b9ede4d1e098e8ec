// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <chrono>

#include "hal/clock.h"

namespace orbwatch::hal {

/// Pauses between attempts to reconnect: 1 s, then 2 s each.
class BackOff {
 public:
  Clock::duration next() {
    const Clock::duration pause = next_;
    next_ = std::min(2 * next_, kLongest);
    return pause;
  }
  /// Call after a successful connection.
  void reset() { next_ = kFirst; }

 private:
  static constexpr Clock::duration kFirst = std::chrono::seconds(1);
  static constexpr Clock::duration kLongest = std::chrono::seconds(2);
  Clock::duration next_ = kFirst;
};

}  // namespace orbwatch::hal
