// SPDX-License-Identifier: Apache-2.0
#include "app/machine/trigger_agreement.h"

#include <algorithm>

namespace orbwatch::app::machine {

int TriggerAgreement::slips(const StateTrack& track, std::uint64_t trigger, hal::TimePoint moment) {
  if (waiting_count_ == kMostWaiting) {
    std::shift_left(waiting_.begin(), waiting_.end(), 1);
    --waiting_count_;
  }
  waiting_[waiting_count_++] = {trigger, moment};
  int count = 0;
  std::size_t judged = 0;
  while (judged < waiting_count_ && track.after(waiting_[judged].moment + kUncertainty)) {
    count += slips(track, waiting_[judged++]) ? 1 : 0;
  }
  std::shift_left(waiting_.begin(), waiting_.begin() + static_cast<std::ptrdiff_t>(waiting_count_),
                  static_cast<std::ptrdiff_t>(judged));
  waiting_count_ -= judged;
  return count;
}

bool TriggerAgreement::slips(const StateTrack& track, const Set& set) {
  const auto bound = [&set](const TimedState* state, double unsent, double none) {
    const double count = state ? state->values.trigger_count : signals::kNotValid;
    return count > 0 ? count + unsent - static_cast<double>(set.trigger) : none;
  };
  // A state before the trigger does not count it; a state after it does.
  const double low = bound(track.before(set.moment - kUncertainty), 1, -kNoBound);
  const double high = bound(track.after(set.moment + kUncertainty), 0, kNoBound);
  low_ = std::max(low_, low);
  high_ = std::min(high_, high);
  if (low_ <= high_) return false;
  low_ = low;
  high_ = high;
  return true;
}

}  // namespace orbwatch::app::machine
