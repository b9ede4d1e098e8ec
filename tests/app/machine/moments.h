// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <chrono>

#include "hal/clock.h"

namespace orbwatch::app::machine::tests {

/// Moments of the steady clock.
inline hal::TimePoint at_ms(int ms) { return hal::TimePoint(std::chrono::milliseconds(ms)); }
inline hal::TimePoint at_s(double s) {
  return hal::TimePoint(
      std::chrono::duration_cast<hal::Clock::duration>(std::chrono::duration<double>(s)));
}

}  // namespace orbwatch::app::machine::tests
