// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstddef>
#include <optional>

#include "hal/clock.h"

namespace orbwatch::app::machine {

/// Moments of a controller's clock on ours. A message is never early, and of many some are not
/// late: the least difference between arrival and the controller's clock over the last seconds is
/// the offset of the clocks, and the jitter of the messages is gone. Thread-bound.
class ControllerClock {
 public:
  /// The moment that `clock`, s, stands for, of a message that came at `arrival`: at most
  /// `arrival`. A clock that was set, seen as a step of more than kStep against the offset, begins
  /// anew.
  hal::TimePoint moment_of(double clock, hal::TimePoint arrival);

 private:
  /// Offsets are kept for kSlots * kSlotTime, so that clocks of 100 ppm difference drift less than
  /// 1 ms apart.
  static constexpr std::size_t kSlots = 8;
  static constexpr std::chrono::seconds kSlotTime{1};
  static constexpr std::chrono::seconds kStep{1};

  void begin(hal::TimePoint arrival);

  std::array<std::optional<hal::Clock::duration>, kSlots> least_;  ///< by slot, newest at slot_
  std::size_t slot_ = 0;
  hal::TimePoint slot_begin_{};
};

}  // namespace orbwatch::app::machine
