// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <functional>

#include "hal/clock.h"
#include "proc/image/result.h"

namespace orbwatch::app {

/// Restart of the program with its files read again. All members may be called on any thread.
struct Restart {
  /// Checks that the files can run; waits for the disk and for the checks of a whole configuration.
  /// Error: the reason, already logged.
  std::function<Result<>()> check;
  /// Requests it and returns. For files that passed check().
  std::function<void()> request;
  /// Time at which the configuration on trial is reverted; max: none is on trial.
  std::function<hal::TimePoint()> trial_end = [] { return hal::TimePoint::max(); };
};

}  // namespace orbwatch::app
