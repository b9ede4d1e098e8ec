#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <mutex>
#include <optional>

#include "hal/clock.h"
#include "hal/frame/frame.h"

namespace orbwatch::hal {

/// Tells which exposures have the controls that were set. Cameras do not: a control waits behind
/// the frames that are queued, and a sensor takes it on some exposures later. So exposures are
/// counted; and where a frame states its controls, they must be as set, too.
/// Thread rule: clear and set on any thread, as_of on the camera's.
class ControlDelay {
 public:
  /// The camera starts: from its first exposure on it has what was set while it stood.
  void clear() {
    const std::lock_guard lock(mutex_);
    oldest_.reset();
  }

  /// A control was set; the call that did it is over at `moment`.
  void set(TimePoint moment) {
    const std::lock_guard lock(mutex_);
    if (!oldest_) oldest_ = moment;
    newest_ = moment;
    first_.reset();
  }

  /// The moment before which every control that was set is in effect in an exposure. `delay`: how
  /// many exposures that begin after a set() may be without it.
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
  std::mutex mutex_;
  std::optional<TimePoint> oldest_;  ///< of the settings that may not be in effect; none: all are
  TimePoint newest_;
  std::optional<std::uint64_t> first_;  ///< exposure that began after newest_, by its sequence
};

}  // namespace orbwatch::hal
