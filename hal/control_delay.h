// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <mutex>
#include <optional>

#include "hal/clock.h"
#include "hal/frame/frame.h"
#include "hal/thread/priority_mutex.h"

namespace orbwatch::hal {

/// Determines which exposures have the controls that were set. Cameras do not report it: a control
/// waits behind the queued frames, and a sensor applies it some exposures later. Therefore
/// exposures are counted; if a frame states its controls, they must also match.
/// Thread rule: clear and set on any thread, as_of on the camera's.
class ControlDelay {
 public:
  /// The camera starts: its first exposure already has all controls that were set while it was
  /// stopped.
  void clear() {
    const std::lock_guard lock(mutex_);
    oldest_.reset();
  }

  /// A control was set; the call that set it returned at `moment`.
  void set(TimePoint moment) {
    const std::lock_guard lock(mutex_);
    if (!oldest_) oldest_ = moment;
    newest_ = moment;
    first_.reset();
  }

  /// Every control that was set before the returned moment is in effect in this exposure. `delay`:
  /// number of exposures that may begin after a set() without it.
  TimePoint as_of(const FrameMetadata& metadata, std::size_t delay) {
    const TimePoint start = metadata.exposure_start;
    const std::lock_guard lock(mutex_);
    if (!oldest_) return start;
    if (start >= newest_ && !first_) first_ = metadata.sequence;
    const bool is_over = first_ && metadata.sequence - *first_ >= delay;
    if (!is_over || metadata.not_as_set) return std::min(start, *oldest_ - Clock::duration(1));
    oldest_.reset();
    return start;
  }

 private:
  PriorityMutex mutex_;
  std::optional<TimePoint> oldest_;  ///< oldest setting that may not be in effect; none: all are
  TimePoint newest_;
  std::optional<std::uint64_t> first_;  ///< sequence of the first exposure that began after newest_
};

}  // namespace orbwatch::hal
