// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <optional>
#include <utility>

#include "hal/clock.h"

namespace orbwatch::app::dds {

/// Admits a number of events per period and counts the rest. Thread-bound.
class RateLimit {
 public:
  RateLimit(int limit, hal::Clock::duration period) : limit_(limit), period_(period) {}

  /// Admits or withholds one event at `now`. Admitted: returns the number withheld since the
  /// previous admitted one; withheld: nullopt.
  std::optional<std::uint64_t> admit(hal::TimePoint now) {
    if (!start_ || now - *start_ >= period_) {
      start_ = now;
      used_ = 0;
    }
    if (used_ >= limit_) {
      ++withheld_;
      return std::nullopt;
    }
    ++used_;
    return std::exchange(withheld_, 0);
  }

 private:
  int limit_;
  hal::Clock::duration period_;
  int used_ = 0;
  std::uint64_t withheld_ = 0;
  std::optional<hal::TimePoint> start_;  ///< start of the current period
};

}  // namespace orbwatch::app::dds
