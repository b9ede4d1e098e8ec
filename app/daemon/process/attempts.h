// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <functional>
#include <list>
#include <string>

#include "hal/back_off.h"
#include "hal/clock.h"
#include "hal/fault.h"
#include "proc/image/result.h"

namespace orbwatch::app::daemon {

/// What is missing and tried again until it is there, each thing after a BackOff of its own. Its
/// error is logged when it changes, and once that it is there. Thread-bound.
class Attempts {
 public:
  using Attempt = std::function<Result<>()>;
  using CameraAttempt = std::function<hal::DeviceResult<>()>;

  /// Tries at `now`, and again with run() while it fails. Errors name the thing.
  void add(std::string name, Attempt attempt, hal::TimePoint now);

  /// The same for a camera by its name, which the log has as a field, as its fault.
  void add_camera(std::string camera, CameraAttempt attempt, hal::TimePoint now);

  /// Of the next attempt; TimePoint::max(): nothing is missing.
  hal::TimePoint due() const;

  /// Makes the attempts that are due.
  void run(hal::TimePoint now);

 private:
  struct Missing {
    std::string name;
    std::string camera;  ///< empty: it is none
    CameraAttempt attempt;
    hal::FaultReport error;  ///< of the newest attempt
    hal::TimePoint due;
    hal::BackOff pause;
  };

  void add(Missing missing);
  static bool succeeds(Missing& missing, hal::TimePoint now);

  std::list<Missing> missing_;
};

}  // namespace orbwatch::app::daemon
