// SPDX-License-Identifier: Apache-2.0
#include "app/ports/web/history/alarm_history.h"

#include <algorithm>

namespace orbwatch::app::web {

void AlarmHistory::accept(const AlarmNotice& notice) {
  const auto time = hal::to_utc(notice.stamp);
  const std::lock_guard lock(mutex_);
  ring_[count_ % kMost] = {notice, time};
  ++count_;
}

std::vector<AlarmHistory::Entry> AlarmHistory::newest(std::size_t most) const {
  most = std::min(most, kMost);
  // Allocated before locking, so that the pipeline's thread does not wait for it.
  std::vector<Entry> entries;
  entries.reserve(most);
  const std::lock_guard lock(mutex_);
  const std::uint64_t count = count_;
  for (std::uint64_t n = count - std::min<std::uint64_t>(most, count); n < count; ++n) {
    entries.push_back(ring_[n % kMost]);
  }
  return entries;
}

}  // namespace orbwatch::app::web
