#pragma once

#include <chrono>

namespace orbwatch::hal {

/// The one clock of the product: CLOCK_MONOTONIC. Every time stamp inside is of it.
using Clock = std::chrono::steady_clock;
using TimePoint = Clock::time_point;

/// UTC of a moment on the steady clock, for the edge (DDS stamps, log lines) only: measured anew at
/// each call, so it follows corrections of the system clock. Thread-safe.
inline std::chrono::system_clock::time_point to_utc(TimePoint moment) {
  const auto age = Clock::now() - moment;
  return std::chrono::system_clock::now() -
         std::chrono::duration_cast<std::chrono::system_clock::duration>(age);
}

}  // namespace orbwatch::hal
