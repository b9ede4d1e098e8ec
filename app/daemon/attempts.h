#pragma once

#include <functional>
#include <list>
#include <string>

#include "hal/back_off.h"
#include "hal/clock.h"
#include "proc/image/result.h"

namespace orbwatch::app {

/// What is missing and tried again until it is there, each thing after a BackOff of its own. Its
/// error is logged when it changes, and once that it is there. Thread-bound.
class Attempts {
 public:
  using Attempt = std::function<Result<>()>;

  /// Tries at `now`, and again with run() while it fails. Errors name the thing.
  void add(std::string name, Attempt attempt, hal::TimePoint now);

  /// Of the next attempt; TimePoint::max(): nothing is missing.
  hal::TimePoint due() const;

  /// Makes the attempts that are due.
  void run(hal::TimePoint now);

 private:
  struct Missing {
    std::string name;
    Attempt attempt;
    std::string error;  ///< of the newest attempt
    hal::TimePoint due;
    hal::BackOff pause;
  };

  static bool succeeds(Missing& missing, hal::TimePoint now);

  std::list<Missing> missing_;
};

}  // namespace orbwatch::app
