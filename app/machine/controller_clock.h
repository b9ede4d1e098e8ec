// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstddef>
#include <optional>

#include "hal/clock.h"

namespace orbwatch::app::machine {

/// Moments of a controller's clock on ours. A message is never early, and of many some are not
/// late: the least difference between arrival and the controller's clock over the last seconds is
/// the offset of the clocks, and the jitter of the messages is gone. A clock that stands, or whose
/// steps are longer than the jitter, is not used. Thread-bound.
class ControllerClock {
 public:
  /// The moment that `clock`, s, stands for, of a message that came at `arrival`: at most
  /// `arrival`. A clock that was set, seen as a step of more than kStep against the offset, begins
  /// anew at once; one set back by less is followed after two slots. Nullopt: the clock is that of
  /// the message before, which was nearer to its moment. While the clock stands(), the arrival.
  std::optional<hal::TimePoint> moment_of(double clock, hal::TimePoint arrival);

  /// True: one value of the clock came for longer than kLongestValue, now or within the time for
  /// which offsets are kept.
  bool stands(hal::TimePoint arrival) const;

 private:
  /// Offsets are kept for kSlots * kSlotTime, so that clocks of 100 ppm difference drift less than
  /// 1 ms apart.
  static constexpr std::size_t kSlots = 8;
  static constexpr std::chrono::seconds kSlotTime{1};
  static constexpr std::chrono::seconds kStep{1};
  /// Excess of a slot over each older one that neither drift nor jitter explains. After a stall of
  /// the network, which looks the same, the first prompt message corrects the offset.
  static constexpr std::chrono::milliseconds kSetBack{20};
  /// Longer than the steps of usable clocks, 20 ms at most, with the jitter of messages. The log
  /// states it.
  static constexpr std::chrono::milliseconds kLongestValue{50};

  void begin(hal::TimePoint arrival);
  /// The offset: the least of all slots; nullopt before the first message.
  std::optional<hal::Clock::duration> least() const;
  /// True: the newest slot exceeds each older one by more than kSetBack.
  bool was_set_back() const;
  /// Begins the next slot; slots before a clock that was set back are dropped.
  void end_slot();

  std::array<std::optional<hal::Clock::duration>, kSlots> least_;  ///< by slot, newest at slot_
  std::size_t slot_ = 0;
  hal::TimePoint slot_begin_{};
  std::optional<double> newest_clock_;
  hal::TimePoint advanced_{};            ///< arrival of the first message with it
  std::optional<hal::TimePoint> stood_;  ///< arrival of the newest message whose clock stood
};

}  // namespace orbwatch::app::machine
