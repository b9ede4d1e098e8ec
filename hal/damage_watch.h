// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <bitset>
#include <chrono>
#include <cstddef>

#include "hal/clock.h"

namespace orbwatch::hal {

/// Decides when damaged frames are a fault of their camera: when 5 of its last 20 frames are
/// damaged. The fault ends with the first intact frame that is exposed a second or more after the
/// last damaged one, so that a permanently bad camera has one fault and not one per frame.
/// Thread-bound.
class DamageWatch {
 public:
  static constexpr std::size_t kFrames = 20;
  static constexpr std::size_t kTooMany = 5;
  static constexpr std::chrono::seconds kQuiet{1};

  /// Adds a damaged frame that was exposed at `moment`. Returns whether there is a fault.
  bool add_damaged(TimePoint moment) {
    add(true);
    last_damaged_ = moment;
    is_fault_ = is_fault_ || damaged_.count() >= kTooMany;
    return is_fault_;
  }

  /// Adds an intact frame that was exposed at `moment`. Returns whether the fault persists.
  bool add_intact(TimePoint moment) {
    if (is_fault_ && moment - last_damaged_ >= kQuiet) clear();
    add(false);
    return is_fault_;
  }

  bool is_fault() const { return is_fault_; }

  /// Forgets all frames, and the fault.
  void clear() { *this = {}; }

 private:
  void add(bool damaged) {
    damaged_ <<= 1;
    damaged_[0] = damaged;
  }

  std::bitset<kFrames> damaged_;  ///< damage of the last frames, the newest first
  TimePoint last_damaged_{};
  bool is_fault_ = false;
};

}  // namespace orbwatch::hal
