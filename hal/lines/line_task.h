#pragma once

#include "hal/clock.h"

namespace orbwatch::hal {

/// Work of the line thread that is due at moments: pulses, delays, watchdogs. Tests call it with
/// times of their own.
class LineTask {
 public:
  LineTask() = default;
  LineTask(const LineTask&) = delete;
  LineTask& operator=(const LineTask&) = delete;
  virtual ~LineTask() = default;

  /// When run() is wanted; TimePoint::max(): not until something happens.
  virtual TimePoint due() const = 0;

  /// Does what is due at `now`; called earlier, it does nothing.
  virtual void run(TimePoint now) = 0;
};

}  // namespace orbwatch::hal
