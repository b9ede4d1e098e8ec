// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <ostream>
#include <string>
#include <vector>

#include "hal/lines/line.h"

namespace orbwatch::hal {

/// A moment of the tests' own time.
inline TimePoint at(double milliseconds) {
  return TimePoint(std::chrono::duration_cast<Clock::duration>(
      std::chrono::duration<double, std::milli>(milliseconds + 1e6)));
}

inline bool operator==(const EdgeEvent& a, const EdgeEvent& b) {
  return a.edge == b.edge && a.stamp == b.stamp;
}

inline std::ostream& operator<<(std::ostream& out, const EdgeEvent& event) {
  const std::chrono::duration<double, std::milli> when = event.stamp - at(0);
  return out << (event.edge == Edge::Rising ? "rising at " : "falling at ") << when.count();
}

}  // namespace orbwatch::hal
