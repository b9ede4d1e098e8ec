// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "hal/clock.h"

namespace orbwatch::hal {

/// Timed work of the line thread: pulses, delays, watchdogs. Tests pass their own times.
class LineTask {
 public:
  LineTask() = default;
  LineTask(const LineTask&) = delete;
  LineTask& operator=(const LineTask&) = delete;
  virtual ~LineTask() = default;

  /// Moment at which run() is to be called; TimePoint::max(): not before an event.
  virtual TimePoint due() const = 0;

  /// Does the work that is due at `now`; does nothing before due().
  virtual void run(TimePoint now) = 0;
};

}  // namespace orbwatch::hal
