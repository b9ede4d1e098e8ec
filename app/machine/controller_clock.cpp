// SPDX-License-Identifier: Apache-2.0
#include "app/machine/controller_clock.h"

#include <algorithm>

namespace orbwatch::app::machine {

void ControllerClock::begin(hal::TimePoint arrival) {
  least_ = {};
  slot_begin_ = arrival;
}

hal::TimePoint ControllerClock::moment_of(double clock, hal::TimePoint arrival) {
  const auto sent =
      std::chrono::duration_cast<hal::Clock::duration>(std::chrono::duration<double>(clock));
  const hal::Clock::duration offset = arrival.time_since_epoch() - sent;
  if (arrival - slot_begin_ >= kSlots * kSlotTime) begin(arrival);
  while (arrival - slot_begin_ >= kSlotTime) {
    slot_begin_ += kSlotTime;
    slot_ = (slot_ + 1) % kSlots;
    least_[slot_].reset();
  }
  const auto least = [this] {
    std::optional<hal::Clock::duration> all;
    for (const auto& slot : least_) {
      if (slot && (!all || *slot < *all)) all = slot;
    }
    return all;
  };
  if (const auto known = least(); known && (offset - *known > kStep || *known - offset > kStep)) {
    begin(arrival);
  }
  std::optional<hal::Clock::duration>& newest = least_[slot_];
  newest = std::min(newest.value_or(offset), offset);
  return hal::TimePoint(sent + *least());
}

}  // namespace orbwatch::app::machine
