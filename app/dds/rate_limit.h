#pragma once

#include <cstdint>
#include <optional>

#include "hal/clock.h"

namespace orbwatch::app {

/// Lets a number of things per period through and counts the rest. Thread-bound.
class RateLimit {
 public:
  RateLimit(int limit, hal::Clock::duration period) : limit_(limit), period_(period) {}

  /// Whether one more may pass at `now`: then the number withheld since the last one that did, else
  /// nothing.
  std::optional<std::uint64_t> admit(hal::TimePoint now);

 private:
  int limit_;
  hal::Clock::duration period_;
  int used_ = 0;
  std::uint64_t withheld_ = 0;
  std::optional<hal::TimePoint> start_;  ///< of the current period
};

}  // namespace orbwatch::app
