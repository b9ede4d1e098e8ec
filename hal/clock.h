// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <chrono>

namespace orbwatch::hal {

/// The one clock of the product, CLOCK_MONOTONIC: all internal time stamps use it.
using Clock = std::chrono::steady_clock;
using TimePoint = Clock::time_point;

/// Time between two of `rate` events per second; 0 unless the rate is above 0.
inline Clock::duration period_of(double rate) {
  if (rate <= 0) return Clock::duration(0);
  return std::chrono::duration_cast<Clock::duration>(std::chrono::duration<double>(1 / rate));
}

/// UTC of a moment on the steady clock, for interfaces only (DDS stamps, log lines). Follows
/// corrections of the system clock, as the difference is measured at each call. Thread-safe.
inline std::chrono::system_clock::time_point to_utc(TimePoint moment) {
  const auto age = Clock::now() - moment;
  return std::chrono::system_clock::now() -
         std::chrono::duration_cast<std::chrono::system_clock::duration>(age);
}

}  // namespace orbwatch::hal
