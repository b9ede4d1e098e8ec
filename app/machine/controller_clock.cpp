// SPDX-License-Identifier: Apache-2.0
#include "app/machine/controller_clock.h"

#include <algorithm>

namespace orbwatch::app::machine {

void ControllerClock::begin(hal::TimePoint arrival) {
  least_ = {};
  slot_begin_ = arrival;
}

std::optional<hal::Clock::duration> ControllerClock::least() const {
  std::optional<hal::Clock::duration> all;
  for (const auto& slot : least_) {
    if (slot && (!all || *slot < *all)) all = slot;
  }
  return all;
}

bool ControllerClock::was_set_back() const {
  const auto& newest = least_[slot_];
  return newest && std::ranges::all_of(least_, [&newest](const auto& slot) {
           return &slot == &newest || !slot || *newest - *slot > kSetBack;
         });
}

void ControllerClock::end_slot() {
  if (was_set_back()) {
    const auto newest = least_[slot_];
    least_ = {};
    least_[slot_] = newest;
  }
  slot_begin_ += kSlotTime;
  slot_ = (slot_ + 1) % kSlots;
  least_[slot_].reset();
}

bool ControllerClock::stands(hal::TimePoint arrival) const {
  return stood_ && arrival - *stood_ < kSlots * kSlotTime;
}

std::optional<hal::TimePoint> ControllerClock::moment_of(double clock, hal::TimePoint arrival) {
  const bool has_advanced = clock != newest_clock_;
  newest_clock_ = clock;
  if (has_advanced) advanced_ = arrival;
  if (arrival - advanced_ > kLongestValue) stood_ = arrival;
  if (stands(arrival)) return arrival;
  if (!has_advanced) return std::nullopt;
  const auto sent =
      std::chrono::duration_cast<hal::Clock::duration>(std::chrono::duration<double>(clock));
  const hal::Clock::duration offset = arrival.time_since_epoch() - sent;
  if (arrival - slot_begin_ >= kSlots * kSlotTime) begin(arrival);
  while (arrival - slot_begin_ >= kSlotTime) end_slot();
  if (const auto known = least(); known && (offset - *known > kStep || *known - offset > kStep)) {
    begin(arrival);
  }
  std::optional<hal::Clock::duration>& newest = least_[slot_];
  newest = std::min(newest.value_or(offset), offset);
  return hal::TimePoint(sent + *least());
}

}  // namespace orbwatch::app::machine
